// The base of reactors that read a stream: one message after the other, and
// it is noticed when none comes. The caller's rights are checked for every
// message.
#ifndef ARGMESH_SERVER_RPC_READING_REACTOR_H_
#define ARGMESH_SERVER_RPC_READING_REACTOR_H_

#include <memory>
#include <mutex>
#include <utility>

#include "absl/time/time.h"
#include "server/rpc/guarded_reactor.h"
#include "server/rpc/peer_wait.h"

namespace argmesh {

// `Base` is grpc::ServerReadReactor<Request> or a ServerBidiReactor; `Request`
// may be google::protobuf::Message.
template <typename Base, typename Request>
class ReadingReactor : public GuardedReactor<Base> {
 public:
  // Messages are read into `message`.
  ReadingReactor(ServiceEnvironment& environment,
                 grpc::CallbackServerContext* context, const char* method,
                 std::unique_ptr<Request> message = std::make_unique<Request>())
      : GuardedReactor<Base>(environment, context, method),
        message_(std::move(message)) {}

  void OnReadDone(bool ok) final {
    reading_.End();
    this->Guard([&] {
      if (!ok) {
        ReadsEnded();
      } else if (absl::Status status =
                     this->scope().AuthorizeMessage(*message_);
                 !status.ok()) {
        this->FinishOnce(status);
      } else {
        Received(*message_);
      }
    });
  }

 protected:
  // A message; it stays until the next StartNextRead.
  virtual void Received(Request& request) = 0;
  // The client half-closed, went away, or sent what cannot be parsed: gRPC
  // does not say which.
  virtual void ReadsEnded() = 0;

  void StartNextRead() {
    const std::lock_guard lock(this->scope().mutex());
    if (this->scope().finished()) return;
    message_->Clear();
    reading_.Begin();
    this->StartRead(message_.get());
  }

  // How long the client has been silent while a message of it was waited for.
  absl::Duration Silence(absl::Time now) const { return reading_.Lasted(now); }

 private:
  const std::unique_ptr<Request> message_;
  PeerWait reading_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_READING_REACTOR_H_
