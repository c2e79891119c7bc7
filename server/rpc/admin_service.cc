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
#include "server/rpc/unary_reactor.h"

namespace argmesh {
namespace {

constexpr char kSnapshotList[] = "snapshots";

absl::Status ListPage(const StoreAdmin& store,
                      const v1::ListSnapshotsRequest& request,
                      v1::ListSnapshotsResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(const int limit, CheckPageSize(request.page_size()));
  ARGMESH_ASSIGN_OR_RETURN(const std::string after,
                           ParsePageToken(kSnapshotList, request.page_token()));
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<SnapshotRecord> records,
                           store.ListSnapshots());
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

}  // namespace

void AdminServiceImpl::FillServerInfo(
    v1::GetServerInfoResponse* response) const {
  response->set_version(environment_.version);
  response->set_graph_version(kShapeGraphVersion);
  *response->mutable_start_time() = ToTimestamp(start_time_);
  *response->mutable_uptime() = ToDuration(absl::Now() - start_time_);
  v1::ServerLimits& limits = *response->mutable_limits();
  limits.set_max_mesh_bytes(
      environment_.engine.options().mesh_limits.max_bytes);
  limits.set_max_message_bytes(kMaxMessageBytes);
  limits.set_max_inflight_searches(environment_.searches.limit());
  limits.set_max_inflight_uploads(environment_.uploads.limit());
  limits.set_max_inflight_ingests(environment_.ingests.limit());
  limits.set_max_page_size(kMaxPageSize);
  limits.set_max_search_limit(kMaxSearchLimit);
  response->set_calls_in_flight(environment_.calls.in_flight());
  response->set_draining(environment_.calls.draining());
  int64_t shapes = 0;
  int64_t collections = 0;
  for (const CollectionHealth& health : environment_.engine.Health()) {
    ++collections;
    shapes += health.shapes;
  }
  response->set_collection_count(collections);
  response->set_shape_count(shapes);
}

grpc::ServerUnaryReactor* AdminServiceImpl::GetServerInfo(
    grpc::CallbackServerContext* context,
    const v1::GetServerInfoRequest* request,
    v1::GetServerInfoResponse* response) {
  return UnaryReactor::Start(environment_, context, {request, response},
                             {"AdminService.GetServerInfo"},
                             [this, response](const UnaryCall&) {
                               FillServerInfo(response);
                               return absl::OkStatus();
                             });
}

grpc::ServerUnaryReactor* AdminServiceImpl::Serve(
    grpc::CallbackServerContext* context, const UnaryMessages& messages,
    const char* method, std::function<absl::Status(StoreAdmin&)> body) {
  if (environment_.store_admin == nullptr) {
    return UnaryReactor::NotServed(environment_, context, messages.request,
                                   method);
  }
  return UnaryReactor::Start(environment_, context, messages, {method},
                             [this, body = std::move(body)](const UnaryCall&) {
                               return body(*environment_.store_admin);
                             });
}

grpc::ServerUnaryReactor* AdminServiceImpl::CreateSnapshot(
    grpc::CallbackServerContext* context,
    const v1::CreateSnapshotRequest* request,
    google::longrunning::Operation* response) {
  static constexpr char kMethod[] = "AdminService.CreateSnapshot";
  return Serve(
      context, {request, response}, kMethod,
      [this, request, response](StoreAdmin& store) -> absl::Status {
        const std::string& id = request->snapshot_id();
        ARGMESH_RETURN_IF_ERROR(CheckResourceId("snapshot_id", id));
        const auto work = [&store, id](const RunControl& control)
            -> absl::StatusOr<google::protobuf::Any> {
          ARGMESH_ASSIGN_OR_RETURN(const SnapshotRecord record,
                                   store.CreateSnapshot(id, control.stop));
          return Packed(ToProto(record));
        };
        ARGMESH_ASSIGN_OR_RETURN(
            *response,
            environment_.operations.Start(kMethod, SnapshotName(id), work));
        return absl::OkStatus();
      });
}

grpc::ServerUnaryReactor* AdminServiceImpl::GetSnapshot(
    grpc::CallbackServerContext* context, const v1::GetSnapshotRequest* request,
    v1::Snapshot* response) {
  return Serve(context, {request, response}, "AdminService.GetSnapshot",
               [request, response](StoreAdmin& store) -> absl::Status {
                 ARGMESH_ASSIGN_OR_RETURN(
                     const std::string id,
                     ParseSnapshotName("name", request->name()));
                 ARGMESH_ASSIGN_OR_RETURN(const SnapshotRecord record,
                                          store.GetSnapshot(id));
                 *response = ToProto(record);
                 return absl::OkStatus();
               });
}

grpc::ServerUnaryReactor* AdminServiceImpl::ListSnapshots(
    grpc::CallbackServerContext* context,
    const v1::ListSnapshotsRequest* request,
    v1::ListSnapshotsResponse* response) {
  return Serve(context, {request, response}, "AdminService.ListSnapshots",
               [request, response](StoreAdmin& store) {
                 return ListPage(store, *request, response);
               });
}

grpc::ServerUnaryReactor* AdminServiceImpl::DeleteSnapshot(
    grpc::CallbackServerContext* context,
    const v1::DeleteSnapshotRequest* request,
    v1::DeleteSnapshotResponse* response) {
  return Serve(context, {request, response}, "AdminService.DeleteSnapshot",
               [request](StoreAdmin& store) -> absl::Status {
                 ARGMESH_ASSIGN_OR_RETURN(
                     const std::string id,
                     ParseSnapshotName("name", request->name()));
                 return store.DeleteSnapshot(id);
               });
}

grpc::ServerWriteReactor<v1::DownloadSnapshotResponse>*
AdminServiceImpl::DownloadSnapshot(grpc::CallbackServerContext* context,
                                   const v1::DownloadSnapshotRequest* request) {
  return StartReactor<SnapshotReactor>(environment_, context, request);
}

grpc::ServerUnaryReactor* AdminServiceImpl::VerifyStorage(
    grpc::CallbackServerContext* context,
    const v1::VerifyStorageRequest* request,
    google::longrunning::Operation* response) {
  static constexpr char kMethod[] = "AdminService.VerifyStorage";
  return Serve(
      context, {request, response}, kMethod,
      [this, request, response](StoreAdmin& store) -> absl::Status {
        if (!request->collection().empty()) {
          return FieldInvalid("collection",
                              "not served by this version; leave it empty");
        }
        const auto work = [&store](const RunControl& control)
            -> absl::StatusOr<google::protobuf::Any> {
          ARGMESH_ASSIGN_OR_RETURN(const StorageReport report,
                                   store.Verify(control.stop));
          return Packed(ToProto(report));
        };
        ARGMESH_ASSIGN_OR_RETURN(
            *response, environment_.operations.Start(kMethod, "", work));
        return absl::OkStatus();
      });
}

}  // namespace argmesh
