#include "server/rpc/admin_service.h"

#include <utility>
#include <vector>

#include "core/base/status_macros.h"
#include "core/graph/shape_graph.h"
#include "server/engine/page_token.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/convert_snapshot.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/snapshot_reactor.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

constexpr char kSnapshotList[] = "snapshots";
constexpr char kCreateSnapshot[] = "AdminService.CreateSnapshot";
constexpr char kVerifyStorage[] = "AdminService.VerifyStorage";

// METHOD_NOT_SERVED where there is none.
absl::StatusOr<StoreAdmin*> StoreOf(const UnaryCall& call, const char* method) {
  StoreAdmin* const store = call.environment.store_admin;
  if (store == nullptr) return MethodNotServed(method);
  return store;
}

absl::Status GetServerInfo(const UnaryCall& call,
                           const v1::GetServerInfoRequest&,
                           v1::GetServerInfoResponse* response) {
  ServiceEnvironment& environment = call.environment;
  response->set_version(environment.version);
  response->set_graph_version(kShapeGraphVersion);
  *response->mutable_start_time() = ToTimestamp(environment.start_time);
  *response->mutable_uptime() =
      ToDuration(absl::Now() - environment.start_time);
  v1::ServerLimits& limits = *response->mutable_limits();
  limits.set_max_mesh_bytes(environment.engine.options().mesh_limits.max_bytes);
  limits.set_max_message_bytes(kMaxMessageBytes);
  limits.set_max_inflight_searches(environment.searches.limit());
  limits.set_max_inflight_uploads(environment.uploads.limit());
  limits.set_max_inflight_ingests(environment.ingests.limit());
  limits.set_max_page_size(kMaxPageSize);
  limits.set_max_search_limit(kMaxSearchLimit);
  response->set_calls_in_flight(environment.calls.in_flight());
  response->set_draining(environment.calls.draining());
  int64_t shapes = 0;
  int64_t collections = 0;
  for (const CollectionHealth& health : environment.engine.Health()) {
    ++collections;
    shapes += health.shapes;
  }
  response->set_collection_count(collections);
  response->set_shape_count(shapes);
  return absl::OkStatus();
}

absl::Status CreateSnapshot(const UnaryCall& call,
                            const v1::CreateSnapshotRequest& request,
                            google::longrunning::Operation* response) {
  ARGMESH_ASSIGN_OR_RETURN(StoreAdmin* const store,
                           StoreOf(call, kCreateSnapshot));
  const std::string& id = request.snapshot_id();
  ARGMESH_RETURN_IF_ERROR(CheckResourceId("snapshot_id", id));
  const auto work =
      [store,
       id](const RunControl& control) -> absl::StatusOr<google::protobuf::Any> {
    ARGMESH_ASSIGN_OR_RETURN(const SnapshotRecord record,
                             store->CreateSnapshot(id, control.stop));
    return Packed(ToProto(record));
  };
  ARGMESH_ASSIGN_OR_RETURN(
      *response, call.environment.operations.Start(kCreateSnapshot,
                                                   SnapshotName(id), work));
  return absl::OkStatus();
}

absl::Status GetSnapshot(const UnaryCall& call,
                         const v1::GetSnapshotRequest& request,
                         v1::Snapshot* response) {
  ARGMESH_ASSIGN_OR_RETURN(StoreAdmin* const store,
                           StoreOf(call, "AdminService.GetSnapshot"));
  ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                           ParseSnapshotName("name", request.name()));
  ARGMESH_ASSIGN_OR_RETURN(const SnapshotRecord record, store->GetSnapshot(id));
  *response = ToProto(record);
  return absl::OkStatus();
}

absl::Status ListSnapshots(const UnaryCall& call,
                           const v1::ListSnapshotsRequest& request,
                           v1::ListSnapshotsResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(StoreAdmin* const store,
                           StoreOf(call, "AdminService.ListSnapshots"));
  ARGMESH_ASSIGN_OR_RETURN(const int limit, CheckPageSize(request.page_size()));
  ARGMESH_ASSIGN_OR_RETURN(const std::string after,
                           ParsePageToken(kSnapshotList, request.page_token()));
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<SnapshotRecord> records,
                           store->ListSnapshots());
  for (const SnapshotRecord& record : records) {
    if (record.id <= after) continue;
    if (response->snapshots_size() == limit) {
      const std::string& last = response->snapshots(limit - 1).name();
      ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                               ParseSnapshotName("name", last));
      response->set_next_page_token(MakePageToken(kSnapshotList, id));
      break;
    }
    *response->add_snapshots() = ToProto(record);
  }
  return absl::OkStatus();
}

absl::Status DeleteSnapshot(const UnaryCall& call,
                            const v1::DeleteSnapshotRequest& request,
                            v1::DeleteSnapshotResponse*) {
  ARGMESH_ASSIGN_OR_RETURN(StoreAdmin* const store,
                           StoreOf(call, "AdminService.DeleteSnapshot"));
  ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                           ParseSnapshotName("name", request.name()));
  return store->DeleteSnapshot(id);
}

absl::Status VerifyStorage(const UnaryCall& call,
                           const v1::VerifyStorageRequest& request,
                           google::longrunning::Operation* response) {
  ARGMESH_ASSIGN_OR_RETURN(StoreAdmin* const store,
                           StoreOf(call, kVerifyStorage));
  std::string collection;
  if (!request.collection().empty()) {
    ARGMESH_ASSIGN_OR_RETURN(
        collection, ParseCollectionName("collection", request.collection()));
  }
  const auto work =
      [store, collection](
          const RunControl& control) -> absl::StatusOr<google::protobuf::Any> {
    ARGMESH_ASSIGN_OR_RETURN(const StorageReport report,
                             store->Verify(collection, control.stop));
    return Packed(ToProto(report));
  };
  ARGMESH_ASSIGN_OR_RETURN(
      *response, call.environment.operations.Start(kVerifyStorage,
                                                   request.collection(), work));
  return absl::OkStatus();
}

}  // namespace

AdminServiceImpl::AdminServiceImpl(ServiceEnvironment& environment)
    : RpcService(environment) {
  Unary({"AdminService.GetServerInfo"}, GetServerInfo);
  Unary({kCreateSnapshot}, CreateSnapshot);
  Unary({"AdminService.GetSnapshot"}, GetSnapshot);
  Unary({"AdminService.ListSnapshots"}, ListSnapshots);
  Unary({"AdminService.DeleteSnapshot"}, DeleteSnapshot);
  Stream<SnapshotReactor>("AdminService.DownloadSnapshot");
  Unary({kVerifyStorage}, VerifyStorage);
}

}  // namespace argmesh
