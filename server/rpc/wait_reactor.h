// Operations.WaitOperation: answers when the operation is done, or as it is
// after the timeout, at the drain, or just before the caller's deadline.
//
// Holds no thread while it waits.
#ifndef ARGMESH_SERVER_RPC_WAIT_REACTOR_H_
#define ARGMESH_SERVER_RPC_WAIT_REACTOR_H_

#include <mutex>
#include <string>

#include "google/longrunning/operations.pb.h"
#include "server/rpc/answering_reactor.h"
#include "server/rpc/request_reactor.h"

namespace argmesh {

class WaitReactor final
    : public AnsweringReactor<
          google::longrunning::Operation,
          RequestReactor<
              grpc::ServerBidiReactor<google::longrunning::WaitOperationRequest,
                                      google::longrunning::Operation>,
              google::longrunning::WaitOperationRequest>> {
 public:
  WaitReactor(ServiceEnvironment& environment,
              grpc::CallbackServerContext* context);

  void OnTick(absl::Time now) override;
  void OnDrain(absl::Duration grace) override;

 protected:
  void Requested(
      std::shared_ptr<const google::longrunning::WaitOperationRequest> request)
      override;
  void Cancelled() override;

 private:
  // Ends the call when the operation is done or `now` is late enough.
  void Look(absl::Time now);

  std::mutex look_mutex_;  // ticks and the beginning
  bool answered_ = false;
  std::string id_;  // empty before the request is there
  absl::Time end_ = absl::InfiniteFuture();
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_WAIT_REACTOR_H_
