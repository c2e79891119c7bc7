// Snapshots and reports of the store as admin_service.proto says them.
#ifndef ARGMESH_SERVER_RPC_CONVERT_SNAPSHOT_H_
#define ARGMESH_SERVER_RPC_CONVERT_SNAPSHOT_H_

#include "argmesh/v1/admin_service.pb.h"
#include "server/engine/store_admin.h"

namespace argmesh {

v1::Snapshot ToProto(const SnapshotRecord& record);
v1::VerifyStorageResponse ToProto(const StorageReport& report);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_SNAPSHOT_H_
