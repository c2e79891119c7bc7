#include "server/rpc/search_service.h"

#include <utility>
#include <variant>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_search.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"
#include "server/rpc/stream_search_reactor.h"
#include "server/rpc/unary_reactor.h"

namespace argmesh {
namespace {

absl::StatusOr<v1::SearchShapesResponse> Search(
    const Engine& engine, const v1::SearchShapesRequest& request,
    int64_t max_bytes, const StopToken& stop) {
  ARGMESH_ASSIGN_OR_RETURN(const SearchQuery query, FromProto(request));
  ARGMESH_ASSIGN_OR_RETURN(const SearchAnswer answer,
                           engine.Search(query, stop));
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

absl::Status BatchSearch(const Engine& engine,
                         const v1::BatchSearchShapesRequest& request,
                         const StopToken& stop,
                         v1::BatchSearchShapesResponse* response) {
  ARGMESH_RETURN_IF_ERROR(CheckBatch(request));
  int64_t bytes_left = kMaxAnswerBytes;
  for (int i = 0; i < request.requests_size(); ++i) {
    v1::SearchShapesRequest search = request.requests(i);
    search.set_parent(request.parent());
    const int64_t share = bytes_left / (request.requests_size() - i);
    auto found = Search(engine, search, share, stop);
    if (found.ok() && static_cast<int64_t>(found->ByteSizeLong()) > share) {
      found = MakeError(ErrorReason::kResponseTooLarge,
                        "the answer does not fit beside those of the others");
    }
    v1::SearchShapesResponse& added = *response->add_responses();
    if (found.ok()) {
      added = *std::move(found);
    } else if (IsOwnFailure(found.status(), stop)) {
      (*response->mutable_failed_requests())[i] = ToProtoStatus(found.status());
    } else {
      return stop.Check().ok() ? found.status() : stop.Check();
    }
    bytes_left -= static_cast<int64_t>(added.ByteSizeLong());
  }
  return absl::OkStatus();
}

absl::Status Compare(Engine& engine, const v1::CompareShapesRequest& request,
                     const StopToken& stop,
                     v1::CompareShapesResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(const CompareQuery query, FromProto(request));
  ARGMESH_ASSIGN_OR_RETURN(const ComparedShapes compared,
                           engine.Compare(query, stop));
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

grpc::ServerUnaryReactor* SearchServiceImpl::SearchShapes(
    grpc::CallbackServerContext* context,
    const v1::SearchShapesRequest* request,
    v1::SearchShapesResponse* response) {
  return UnaryReactor::Start(
      environment_, context, {request, response},
      {"SearchService.SearchShapes", WorkClass::kSearch,
       &environment_.searches},
      [this, request, response](const UnaryCall& call) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(
            *response,
            Search(environment_.engine, *request, kMaxAnswerBytes, call.stop));
        return absl::OkStatus();
      });
}

grpc::ServerBidiReactor<v1::StreamSearchShapesRequest,
                        v1::StreamSearchShapesResponse>*
SearchServiceImpl::StreamSearchShapes(grpc::CallbackServerContext* context) {
  return StartReactor<StreamSearchReactor>(environment_, context);
}

grpc::ServerUnaryReactor* SearchServiceImpl::BatchSearchShapes(
    grpc::CallbackServerContext* context,
    const v1::BatchSearchShapesRequest* request,
    v1::BatchSearchShapesResponse* response) {
  return UnaryReactor::Start(environment_, context, {request, response},
                             {"SearchService.BatchSearchShapes",
                              WorkClass::kSearch, &environment_.searches},
                             [this, request, response](const UnaryCall& call) {
                               return BatchSearch(environment_.engine, *request,
                                                  call.stop, response);
                             });
}

grpc::ServerUnaryReactor* SearchServiceImpl::CompareShapes(
    grpc::CallbackServerContext* context,
    const v1::CompareShapesRequest* request,
    v1::CompareShapesResponse* response) {
  return UnaryReactor::Start(environment_, context, {request, response},
                             {"SearchService.CompareShapes", WorkClass::kSearch,
                              &environment_.searches},
                             [this, request, response](const UnaryCall& call) {
                               return Compare(environment_.engine, *request,
                                              call.stop, response);
                             });
}

}  // namespace argmesh
