// ShapeService.DownloadMesh: one header, then chunks.
#ifndef ARGMESH_SERVER_RPC_DOWNLOAD_REACTOR_H_
#define ARGMESH_SERVER_RPC_DOWNLOAD_REACTOR_H_

#include <memory>

#include "argmesh/v1/shape_service.pb.h"
#include "server/rpc/writing_reactor.h"

namespace argmesh {

class DownloadReactor final : public WritingReactor<v1::DownloadMeshResponse> {
 public:
  // gRPC keeps `request` as long as the call.
  DownloadReactor(ServiceEnvironment& environment,
                  grpc::CallbackServerContext* context,
                  const v1::DownloadMeshRequest* request);

 protected:
  void Begin() override;
  absl::StatusOr<bool> Continue(v1::DownloadMeshResponse& next) override;

 private:
  absl::Status Open(v1::DownloadMeshResponse& first);

  const v1::DownloadMeshRequest* const request_;
  std::unique_ptr<MeshReader> reader_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_DOWNLOAD_REACTOR_H_
