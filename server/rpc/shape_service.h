// argmesh.v1.ShapeService.
#ifndef ARGMESH_SERVER_RPC_SHAPE_SERVICE_H_
#define ARGMESH_SERVER_RPC_SHAPE_SERVICE_H_

#include "argmesh/v1/shape_service.grpc.pb.h"
#include "server/rpc/service_environment.h"

namespace argmesh {

class ShapeServiceImpl final : public v1::ShapeService::CallbackService {
 public:
  // `environment` must outlive the service.
  explicit ShapeServiceImpl(ServiceEnvironment& environment)
      : environment_(environment) {}

  grpc::ServerUnaryReactor* CreateShape(grpc::CallbackServerContext* context,
                                        const v1::CreateShapeRequest* request,
                                        v1::Shape* response) override;
  grpc::ServerReadReactor<v1::UploadShapeRequest>* UploadShape(
      grpc::CallbackServerContext* context, v1::Shape* response) override;
  grpc::ServerUnaryReactor* GetShape(grpc::CallbackServerContext* context,
                                     const v1::GetShapeRequest* request,
                                     v1::Shape* response) override;
  grpc::ServerUnaryReactor* ListShapes(
      grpc::CallbackServerContext* context,
      const v1::ListShapesRequest* request,
      v1::ListShapesResponse* response) override;
  grpc::ServerUnaryReactor* UpdateShape(grpc::CallbackServerContext* context,
                                        const v1::UpdateShapeRequest* request,
                                        v1::Shape* response) override;
  grpc::ServerUnaryReactor* DeleteShape(
      grpc::CallbackServerContext* context,
      const v1::DeleteShapeRequest* request,
      v1::DeleteShapeResponse* response) override;
  grpc::ServerUnaryReactor* BatchGetShapes(
      grpc::CallbackServerContext* context,
      const v1::BatchGetShapesRequest* request,
      v1::BatchGetShapesResponse* response) override;
  grpc::ServerUnaryReactor* BatchDeleteShapes(
      grpc::CallbackServerContext* context,
      const v1::BatchDeleteShapesRequest* request,
      v1::BatchDeleteShapesResponse* response) override;
  grpc::ServerWriteReactor<v1::DownloadMeshResponse>* DownloadMesh(
      grpc::CallbackServerContext* context,
      const v1::DownloadMeshRequest* request) override;
  grpc::ServerUnaryReactor* GetShapeGraph(
      grpc::CallbackServerContext* context,
      const v1::GetShapeGraphRequest* request,
      v1::GetShapeGraphResponse* response) override;

 private:
  ServiceEnvironment& environment_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_SHAPE_SERVICE_H_
