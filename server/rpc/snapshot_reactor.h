// AdminService.DownloadSnapshot: the snapshot, then its bytes in chunks.
#ifndef ARGMESH_SERVER_RPC_SNAPSHOT_REACTOR_H_
#define ARGMESH_SERVER_RPC_SNAPSHOT_REACTOR_H_

#include <memory>
#include <string>

#include "argmesh/v1/admin_service.pb.h"
#include "server/rpc/request_reactor.h"
#include "server/rpc/writing_reactor.h"

namespace argmesh {

class SnapshotReactor final
    : public WritingReactor<
          v1::DownloadSnapshotResponse,
          RequestReactor<grpc::ServerBidiReactor<v1::DownloadSnapshotRequest,
                                                 v1::DownloadSnapshotResponse>,
                         v1::DownloadSnapshotRequest>> {
 public:
  SnapshotReactor(ServiceEnvironment& environment,
                  grpc::CallbackServerContext* context);

 protected:
  void Requested(
      std::shared_ptr<const v1::DownloadSnapshotRequest> request) override;
  absl::StatusOr<bool> Continue(v1::DownloadSnapshotResponse& next) override;

 private:
  absl::Status Open(v1::DownloadSnapshotResponse& first);

  std::string name_;  // of what is asked for
  std::unique_ptr<SnapshotReader> reader_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_SNAPSHOT_REACTOR_H_
