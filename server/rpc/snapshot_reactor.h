// AdminService.DownloadSnapshot: the snapshot, then its bytes in chunks.
#ifndef ARGMESH_SERVER_RPC_SNAPSHOT_REACTOR_H_
#define ARGMESH_SERVER_RPC_SNAPSHOT_REACTOR_H_

#include <memory>

#include "argmesh/v1/admin_service.pb.h"
#include "server/rpc/writing_reactor.h"

namespace argmesh {

class SnapshotReactor final
    : public WritingReactor<v1::DownloadSnapshotResponse> {
 public:
  // gRPC keeps `request` as long as the call.
  SnapshotReactor(ServiceEnvironment& environment,
                  grpc::CallbackServerContext* context,
                  const v1::DownloadSnapshotRequest* request);

 protected:
  void Begin() override;
  absl::StatusOr<bool> Continue(v1::DownloadSnapshotResponse& next) override;

 private:
  absl::Status Open(v1::DownloadSnapshotResponse& first);

  const v1::DownloadSnapshotRequest* const request_;
  std::unique_ptr<SnapshotReader> reader_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_SNAPSHOT_REACTOR_H_
