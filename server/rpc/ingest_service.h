// argmesh.v1.IngestService.
#ifndef ARGMESH_SERVER_RPC_INGEST_SERVICE_H_
#define ARGMESH_SERVER_RPC_INGEST_SERVICE_H_

#include "argmesh/v1/ingest_service.grpc.pb.h"
#include "server/rpc/service_environment.h"

namespace argmesh {

class IngestServiceImpl final : public v1::IngestService::CallbackService {
 public:
  // `environment` must outlive the service.
  explicit IngestServiceImpl(ServiceEnvironment& environment)
      : environment_(environment) {}

  grpc::ServerBidiReactor<v1::IngestShapesRequest, v1::IngestShapesResponse>*
  IngestShapes(grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* ImportShapes(
      grpc::CallbackServerContext* context,
      const v1::ImportShapesRequest* request,
      google::longrunning::Operation* response) override;

 private:
  ServiceEnvironment& environment_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_INGEST_SERVICE_H_
