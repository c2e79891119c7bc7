// Operations.WaitOperation: answers when the operation is done, or as it is
// after the timeout, at the drain, or just before the caller's deadline.
//
// Holds no thread while it waits.
#ifndef ARGMESH_SERVER_RPC_WAIT_REACTOR_H_
#define ARGMESH_SERVER_RPC_WAIT_REACTOR_H_

#include <mutex>
#include <string>

#include "google/longrunning/operations.pb.h"
#include "server/rpc/guarded_reactor.h"

namespace argmesh {

class WaitReactor final : public GuardedReactor<grpc::ServerUnaryReactor> {
 public:
  // gRPC keeps `request` and `response` as long as the call.
  WaitReactor(ServiceEnvironment& environment,
              grpc::CallbackServerContext* context,
              const google::longrunning::WaitOperationRequest* request,
              google::longrunning::Operation* response);

  void OnTick(absl::Time now) override;
  void OnDrain(absl::Duration grace) override;

 protected:
  void Begin() override;
  void Cancelled() override;

 private:
  // Ends the call when the operation is done or `now` is late enough.
  void Look(absl::Time now);

  const google::longrunning::WaitOperationRequest* const request_;
  google::longrunning::Operation* const response_;
  std::mutex look_mutex_;  // ticks and the beginning
  bool answered_ = false;
  std::string id_;  // empty before Begin
  absl::Time end_ = absl::InfiniteFuture();
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_WAIT_REACTOR_H_
