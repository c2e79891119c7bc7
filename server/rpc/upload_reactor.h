// ShapeService.UploadShape: one header, then chunks, then the stored shape.
#ifndef ARGMESH_SERVER_RPC_UPLOAD_REACTOR_H_
#define ARGMESH_SERVER_RPC_UPLOAD_REACTOR_H_

#include <memory>

#include "argmesh/v1/shape_service.pb.h"
#include "server/rpc/answering_reactor.h"
#include "server/rpc/mesh_stream_reactor.h"

namespace argmesh {

class UploadReactor final
    : public AnsweringReactor<
          v1::Shape, MeshStreamReactor<grpc::ServerBidiReactor<
                                           v1::UploadShapeRequest, v1::Shape>,
                                       v1::UploadShapeRequest>> {
 public:
  UploadReactor(ServiceEnvironment& environment,
                grpc::CallbackServerContext* context);

 protected:
  absl::StatusOr<UploadAnnouncement> Announced(
      const v1::UploadShapeRequest& first) override;
  absl::Status Take(std::unique_ptr<StagedMesh> mesh) override;

 private:
  NewShape shape_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_UPLOAD_REACTOR_H_
