// argmesh.v1.SearchService.
#ifndef ARGMESH_SERVER_RPC_SEARCH_SERVICE_H_
#define ARGMESH_SERVER_RPC_SEARCH_SERVICE_H_

#include "argmesh/v1/search_service.grpc.pb.h"
#include "server/rpc/service_environment.h"

namespace argmesh {

class SearchServiceImpl final : public v1::SearchService::CallbackService {
 public:
  // `environment` must outlive the service.
  explicit SearchServiceImpl(ServiceEnvironment& environment)
      : environment_(environment) {}

  grpc::ServerUnaryReactor* SearchShapes(
      grpc::CallbackServerContext* context,
      const v1::SearchShapesRequest* request,
      v1::SearchShapesResponse* response) override;
  grpc::ServerBidiReactor<v1::StreamSearchShapesRequest,
                          v1::StreamSearchShapesResponse>*
  StreamSearchShapes(grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* BatchSearchShapes(
      grpc::CallbackServerContext* context,
      const v1::BatchSearchShapesRequest* request,
      v1::BatchSearchShapesResponse* response) override;
  grpc::ServerUnaryReactor* CompareShapes(
      grpc::CallbackServerContext* context,
      const v1::CompareShapesRequest* request,
      v1::CompareShapesResponse* response) override;

 private:
  ServiceEnvironment& environment_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_SEARCH_SERVICE_H_
