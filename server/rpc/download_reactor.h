// ShapeService.DownloadMesh: one header, then chunks.
#ifndef ARGMESH_SERVER_RPC_DOWNLOAD_REACTOR_H_
#define ARGMESH_SERVER_RPC_DOWNLOAD_REACTOR_H_

#include <memory>
#include <string>

#include "argmesh/v1/shape_service.pb.h"
#include "server/rpc/request_reactor.h"
#include "server/rpc/writing_reactor.h"

namespace argmesh {

class DownloadReactor final
    : public WritingReactor<
          v1::DownloadMeshResponse,
          RequestReactor<grpc::ServerBidiReactor<v1::DownloadMeshRequest,
                                                 v1::DownloadMeshResponse>,
                         v1::DownloadMeshRequest>> {
 public:
  DownloadReactor(ServiceEnvironment& environment,
                  grpc::CallbackServerContext* context);

 protected:
  void Requested(
      std::shared_ptr<const v1::DownloadMeshRequest> request) override;
  absl::StatusOr<bool> Continue(v1::DownloadMeshResponse& next) override;

 private:
  absl::Status Open(v1::DownloadMeshResponse& first);

  std::string name_;  // of what is asked for
  std::unique_ptr<MeshReader> reader_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_DOWNLOAD_REACTOR_H_
