// argmesh.v1.AdminService.
#ifndef ARGMESH_SERVER_RPC_ADMIN_SERVICE_H_
#define ARGMESH_SERVER_RPC_ADMIN_SERVICE_H_

#include <functional>

#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "argmesh/v1/admin_service.grpc.pb.h"
#include "server/rpc/service_environment.h"
#include "server/rpc/unary_reactor.h"

namespace argmesh {

class AdminServiceImpl final : public v1::AdminService::CallbackService {
 public:
  // `environment` must outlive the service.
  explicit AdminServiceImpl(ServiceEnvironment& environment)
      : environment_(environment), start_time_(absl::Now()) {}

  grpc::ServerUnaryReactor* GetServerInfo(
      grpc::CallbackServerContext* context,
      const v1::GetServerInfoRequest* request,
      v1::GetServerInfoResponse* response) override;
  grpc::ServerUnaryReactor* CreateSnapshot(
      grpc::CallbackServerContext* context,
      const v1::CreateSnapshotRequest* request,
      google::longrunning::Operation* response) override;
  grpc::ServerUnaryReactor* GetSnapshot(grpc::CallbackServerContext* context,
                                        const v1::GetSnapshotRequest* request,
                                        v1::Snapshot* response) override;
  grpc::ServerUnaryReactor* ListSnapshots(
      grpc::CallbackServerContext* context,
      const v1::ListSnapshotsRequest* request,
      v1::ListSnapshotsResponse* response) override;
  grpc::ServerUnaryReactor* DeleteSnapshot(
      grpc::CallbackServerContext* context,
      const v1::DeleteSnapshotRequest* request,
      v1::DeleteSnapshotResponse* response) override;
  grpc::ServerWriteReactor<v1::DownloadSnapshotResponse>* DownloadSnapshot(
      grpc::CallbackServerContext* context,
      const v1::DownloadSnapshotRequest* request) override;
  grpc::ServerUnaryReactor* VerifyStorage(
      grpc::CallbackServerContext* context,
      const v1::VerifyStorageRequest* request,
      google::longrunning::Operation* response) override;

 private:
  // `body` on the pool; METHOD_NOT_SERVED where there is no StoreAdmin.
  grpc::ServerUnaryReactor* Serve(
      grpc::CallbackServerContext* context, const UnaryMessages& messages,
      const char* method, std::function<absl::Status(StoreAdmin&)> body);
  void FillServerInfo(v1::GetServerInfoResponse* response) const;

  ServiceEnvironment& environment_;
  const absl::Time start_time_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ADMIN_SERVICE_H_
