#include "server/rpc/snapshot_reactor.h"

#include <utility>

#include "core/base/status_macros.h"
#include "server/rpc/convert_snapshot.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"

namespace argmesh {

SnapshotReactor::SnapshotReactor(ServiceEnvironment& environment,
                                 grpc::CallbackServerContext* context)
    : WritingReactor(environment, context, "AdminService.DownloadSnapshot") {}

void SnapshotReactor::Requested(
    std::shared_ptr<const v1::DownloadSnapshotRequest> request) {
  name_ = request->name();
  Run(WorkClass::kQuick, [this] { SendNext(); });
}

absl::Status SnapshotReactor::Open(v1::DownloadSnapshotResponse& first) {
  StoreAdmin* store = environment().store_admin;
  if (store == nullptr) return MethodNotServed("AdminService.DownloadSnapshot");
  ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                           ParseSnapshotName("name", name_));
  ARGMESH_ASSIGN_OR_RETURN(reader_, store->OpenSnapshot(id));
  *first.mutable_snapshot() = ToProto(reader_->record());
  return absl::OkStatus();
}

absl::StatusOr<bool> SnapshotReactor::Continue(
    v1::DownloadSnapshotResponse& next) {
  if (reader_ == nullptr) {
    ARGMESH_RETURN_IF_ERROR(Open(next));
    return true;
  }
  ARGMESH_ASSIGN_OR_RETURN(std::string chunk,
                           reader_->Read(kDownloadChunkBytes));
  if (chunk.empty()) return false;
  next.set_chunk(std::move(chunk));
  return true;
}

}  // namespace argmesh
