#include "server/rpc/search_service.h"

#include <utility>
#include <variant>

#include "core/base/status_macros.h"
#include "server/rpc/convert_search.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/unary_reactor.h"
#include "server/rpc/unserved_stream.h"

namespace argmesh {
namespace {

absl::Status Search(Engine& engine, const v1::SearchShapesRequest& request,
                    const StopToken& stop, v1::SearchShapesResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(const SearchQuery query, FromProto(request));
  ARGMESH_ASSIGN_OR_RETURN(const SearchAnswer answer,
                           engine.Search(query, stop));
  *response = ToProto(answer, {.mode = query.mode,
                               .explain = request.explain(),
                               .query_graph = request.return_query_graph(),
                               .max_bytes = kMaxAnswerBytes});
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
  return UnaryReactor::Start(environment_, context, request,
                             {"SearchService.SearchShapes", WorkClass::kSearch,
                              &environment_.searches},
                             [this, request, response](const UnaryCall& call) {
                               return Search(environment_.engine, *request,
                                             call.stop, response);
                             });
}

grpc::ServerBidiReactor<v1::StreamSearchShapesRequest,
                        v1::StreamSearchShapesResponse>*
SearchServiceImpl::StreamSearchShapes(grpc::CallbackServerContext* context) {
  using Reactor = grpc::ServerBidiReactor<v1::StreamSearchShapesRequest,
                                          v1::StreamSearchShapesResponse>;
  return StartReactor<UnservedStream<Reactor>>(
      environment_, context, nullptr, "SearchService.StreamSearchShapes");
}

grpc::ServerUnaryReactor* SearchServiceImpl::BatchSearchShapes(
    grpc::CallbackServerContext* context,
    const v1::BatchSearchShapesRequest* request,
    v1::BatchSearchShapesResponse*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "SearchService.BatchSearchShapes");
}

grpc::ServerUnaryReactor* SearchServiceImpl::CompareShapes(
    grpc::CallbackServerContext* context,
    const v1::CompareShapesRequest* request,
    v1::CompareShapesResponse* response) {
  return UnaryReactor::Start(environment_, context, request,
                             {"SearchService.CompareShapes", WorkClass::kSearch,
                              &environment_.searches},
                             [this, request, response](const UnaryCall& call) {
                               return Compare(environment_.engine, *request,
                                              call.stop, response);
                             });
}

}  // namespace argmesh
