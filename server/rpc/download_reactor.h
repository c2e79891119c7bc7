// ShapeService.DownloadMesh: one header, then chunks.
//
// Holds one chunk at a time; a client that takes nothing for the stream idle
// timeout is cut off.
#ifndef ARGMESH_SERVER_RPC_DOWNLOAD_REACTOR_H_
#define ARGMESH_SERVER_RPC_DOWNLOAD_REACTOR_H_

#include <memory>

#include "argmesh/v1/shape_service.pb.h"
#include "server/rpc/guarded_reactor.h"

namespace argmesh {

class DownloadReactor final
    : public GuardedReactor<
          grpc::ServerWriteReactor<v1::DownloadMeshResponse>> {
 public:
  // gRPC keeps `request` as long as the call.
  DownloadReactor(ServiceEnvironment& environment,
                  grpc::CallbackServerContext* context,
                  const v1::DownloadMeshRequest* request);

  void OnWriteDone(bool ok) override;
  void OnTick(absl::Time now) override;

 protected:
  void Begin() override;

 private:
  absl::Status Open();
  // True when there is one more chunk in response_.
  absl::StatusOr<bool> ReadChunk();
  void SendResponse();

  const v1::DownloadMeshRequest* const request_;
  std::unique_ptr<MeshReader> reader_;
  v1::DownloadMeshResponse response_;
  // With the scope's mutex: when the write under way began.
  absl::Time writing_since_ = absl::InfiniteFuture();
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_DOWNLOAD_REACTOR_H_
