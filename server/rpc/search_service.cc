#include "server/rpc/search_service.h"

#include <utility>
#include <variant>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_search.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/measured_search.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"
#include "server/rpc/stream_search_reactor.h"

namespace argmesh {
namespace {

absl::StatusOr<v1::SearchShapesResponse> Search(
    ServiceEnvironment& environment, const v1::SearchShapesRequest& request,
    int64_t max_bytes, const StopToken& stop) {
  ARGMESH_ASSIGN_OR_RETURN(const SearchQuery query, FromProto(request));
  ARGMESH_ASSIGN_OR_RETURN(const SearchAnswer answer,
                           MeasuredSearch(environment, query, stop));
  return ToProto(answer, {.mode = query.mode,
                          .explain = request.explain(),
                          .query_graph = request.return_query_graph(),
                          .max_bytes = max_bytes});
}

absl::Status CheckBatch(const v1::BatchSearchShapesRequest& request) {
  ARGMESH_RETURN_IF_ERROR(
      ParseCollectionName("parent", request.parent()).status());
  if (request.requests().empty()) return FieldRequired("requests");
  if (request.requests_size() > kMaxBatchSearches) {
    return FieldInvalid(
        "requests",
        absl::StrFormat("%d searches, the limit is %d", request.requests_size(),
                        kMaxBatchSearches));
  }
  for (const v1::SearchShapesRequest& search : request.requests()) {
    if (!search.parent().empty() && search.parent() != request.parent()) {
      return FieldInvalid("requests.parent",
                          search.parent() + " is not " + request.parent());
    }
  }
  return absl::OkStatus();
}

// Whether only this search failed, not the whole batch.
bool IsOwnFailure(const absl::Status& status, const StopToken& stop) {
  return stop.Check().ok() &&
         ReasonOf(status).value_or(ErrorReason::kInternal) !=
             ErrorReason::kInternal;
}

absl::Status SearchShapes(const UnaryCall& call,
                          const v1::SearchShapesRequest& request,
                          v1::SearchShapesResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(
      *response, Search(call.environment, request, kMaxAnswerBytes, call.stop));
  return absl::OkStatus();
}

absl::Status BatchSearchShapes(const UnaryCall& call,
                               const v1::BatchSearchShapesRequest& request,
                               v1::BatchSearchShapesResponse* response) {
  ARGMESH_RETURN_IF_ERROR(CheckBatch(request));
  int64_t bytes_left = kMaxAnswerBytes;
  for (int i = 0; i < request.requests_size(); ++i) {
    v1::SearchShapesRequest search = request.requests(i);
    search.set_parent(request.parent());
    const int64_t share = bytes_left / (request.requests_size() - i);
    auto found = Search(call.environment, search, share, call.stop);
    if (found.ok() && static_cast<int64_t>(found->ByteSizeLong()) > share) {
      found = MakeError(ErrorReason::kResponseTooLarge,
                        "the answer does not fit beside those of the others");
    }
    v1::SearchShapesResponse& added = *response->add_responses();
    if (found.ok()) {
      added = *std::move(found);
    } else if (IsOwnFailure(found.status(), call.stop)) {
      (*response->mutable_failed_requests())[i] = ToProtoStatus(found.status());
    } else {
      const absl::Status stopped = call.stop.Check();
      return stopped.ok() ? found.status() : stopped;
    }
    bytes_left -= static_cast<int64_t>(added.ByteSizeLong());
  }
  return absl::OkStatus();
}

absl::Status CompareShapes(const UnaryCall& call,
                           const v1::CompareShapesRequest& request,
                           v1::CompareShapesResponse* response) {
  Engine& engine = call.environment.engine;
  ARGMESH_ASSIGN_OR_RETURN(const CompareQuery query, FromProto(request));
  ARGMESH_ASSIGN_OR_RETURN(const ComparedShapes compared,
                           engine.Compare(query, call.stop));
  *response = ToProto(compared, {.mode = query.mode,
                                 .explain = request.explain(),
                                 .max_bytes = kMaxAnswerBytes});
  if (const auto* target = std::get_if<ShapeRef>(&query.b)) {
    ARGMESH_ASSIGN_OR_RETURN(const ShapeRecord record,
                             engine.GetShape(*target));
    *response->mutable_match()->mutable_shape() = ToProto(record);
  }
  return absl::OkStatus();
}

}  // namespace

SearchServiceImpl::SearchServiceImpl(ServiceEnvironment& environment)
    : RpcService(environment) {
  const auto search = [&environment](const char* method) {
    return UnaryPlan{method, WorkClass::kSearch, &environment.searches};
  };
  Unary(search("SearchService.SearchShapes"), SearchShapes);
  Stream<StreamSearchReactor>("SearchService.StreamSearchShapes");
  Unary(search("SearchService.BatchSearchShapes"), BatchSearchShapes);
  Unary(search("SearchService.CompareShapes"), CompareShapes);
}

}  // namespace argmesh
