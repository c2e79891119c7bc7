// ShapeService.UploadShape: one header, then chunks, then the stored shape.
#ifndef ARGMESH_SERVER_RPC_UPLOAD_REACTOR_H_
#define ARGMESH_SERVER_RPC_UPLOAD_REACTOR_H_

#include <memory>

#include "argmesh/v1/shape_service.pb.h"
#include "server/rpc/mesh_stream_reactor.h"

namespace argmesh {

class UploadReactor final
    : public MeshStreamReactor<grpc::ServerReadReactor<v1::UploadShapeRequest>,
                               v1::UploadShapeRequest> {
 public:
  UploadReactor(ServiceEnvironment& environment,
                grpc::CallbackServerContext* context, v1::Shape* response);

 protected:
  absl::StatusOr<UploadAnnouncement> Announced(
      const v1::UploadShapeRequest& first) override;
  absl::Status Take(std::unique_ptr<StagedMesh> mesh) override;

 private:
  v1::Shape* const response_;
  NewShape shape_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_UPLOAD_REACTOR_H_
