// ShapeService.UploadShape: one header, then chunks, then the stored shape.
//
// Chunks go straight to the disk; the shape is added only when the client has
// half-closed and size and SHA-256 are those of the header. A silent client is
// cut off after the stream idle timeout.
#ifndef ARGMESH_SERVER_RPC_UPLOAD_REACTOR_H_
#define ARGMESH_SERVER_RPC_UPLOAD_REACTOR_H_

#include <memory>

#include "argmesh/v1/shape_service.pb.h"
#include "server/rpc/reading_reactor.h"

namespace argmesh {

class UploadReactor final
    : public ReadingReactor<grpc::ServerReadReactor<v1::UploadShapeRequest>,
                            v1::UploadShapeRequest> {
 public:
  UploadReactor(ServiceEnvironment& environment,
                grpc::CallbackServerContext* context, v1::Shape* response);

  void OnTick(absl::Time now) override;

 protected:
  void Begin() override;
  void Received(v1::UploadShapeRequest& request) override;
  void ReadsEnded() override;

 private:
  absl::Status StartUpload(const v1::UploadShapeHeader& header);
  absl::Status AddShape();

  v1::Shape* const response_;
  NewShape shape_;
  std::unique_ptr<MeshUpload> upload_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_UPLOAD_REACTOR_H_
