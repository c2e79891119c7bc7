#include "server/rpc/admin_service.h"

#include "core/graph/shape_graph.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/unary_reactor.h"
#include "server/rpc/unserved_stream.h"

namespace argmesh {

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
  return UnaryReactor::Start(environment_, context, request,
                             {"AdminService.GetServerInfo"},
                             [this, response](const UnaryCall&) {
                               FillServerInfo(response);
                               return absl::OkStatus();
                             });
}

grpc::ServerUnaryReactor* AdminServiceImpl::CreateSnapshot(
    grpc::CallbackServerContext* context,
    const v1::CreateSnapshotRequest* request, google::longrunning::Operation*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "AdminService.CreateSnapshot");
}

grpc::ServerUnaryReactor* AdminServiceImpl::GetSnapshot(
    grpc::CallbackServerContext* context, const v1::GetSnapshotRequest* request,
    v1::Snapshot*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "AdminService.GetSnapshot");
}

grpc::ServerUnaryReactor* AdminServiceImpl::ListSnapshots(
    grpc::CallbackServerContext* context,
    const v1::ListSnapshotsRequest* request, v1::ListSnapshotsResponse*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "AdminService.ListSnapshots");
}

grpc::ServerUnaryReactor* AdminServiceImpl::DeleteSnapshot(
    grpc::CallbackServerContext* context,
    const v1::DeleteSnapshotRequest* request, v1::DeleteSnapshotResponse*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "AdminService.DeleteSnapshot");
}

grpc::ServerWriteReactor<v1::DownloadSnapshotResponse>*
AdminServiceImpl::DownloadSnapshot(grpc::CallbackServerContext* context,
                                   const v1::DownloadSnapshotRequest* request) {
  using Reactor = grpc::ServerWriteReactor<v1::DownloadSnapshotResponse>;
  return StartReactor<UnservedStream<Reactor>>(environment_, context, request,
                                               "AdminService.DownloadSnapshot");
}

grpc::ServerUnaryReactor* AdminServiceImpl::VerifyStorage(
    grpc::CallbackServerContext* context,
    const v1::VerifyStorageRequest* request, google::longrunning::Operation*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "AdminService.VerifyStorage");
}

}  // namespace argmesh
