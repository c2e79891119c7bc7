// The base of reactors that read a stream: one message after the other, and
// it is noticed when none comes. The caller's rights are checked for every
// message.
//
// The call does not keep what it has read: a message goes with whoever holds it
// last, so that a peer who does not take its answer keeps no request either.
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
  // Messages are of the type of `empty`, which must outlive the call.
  ReadingReactor(ServiceEnvironment& environment,
                 grpc::CallbackServerContext* context, const char* method,
                 const Request& empty = Request::default_instance())
      : GuardedReactor<Base>(environment, context, method), empty_(empty) {}

  void OnReadDone(bool ok) final {
    reading_.End();
    this->Guard([&] {
      std::shared_ptr<Request> message = std::move(message_);
      if (!ok) {
        ReadsEnded();
      } else if (absl::Status status = this->scope().AuthorizeMessage(*message);
                 !status.ok()) {
        this->FinishOnce(status);
      } else {
        Received(std::move(message));
      }
    });
  }

 protected:
  // A message has come. Once for each StartNextRead.
  virtual void Received(std::shared_ptr<Request> request) = 0;
  // The client half-closed, went away, or sent what cannot be parsed: gRPC
  // does not say which.
  virtual void ReadsEnded() = 0;

  void StartNextRead() {
    const std::lock_guard lock(this->scope().mutex());
    if (this->scope().finished()) return;
    message_.reset(empty_.New());
    reading_.Begin();
    this->StartRead(message_.get());
  }

  // A message of the client is waited for.
  bool Waits() const { return reading_.pending(); }
  // How long the client has been silent while a message of it was waited for.
  absl::Duration Silence(absl::Time now) const { return reading_.Lasted(now); }

 private:
  const Request& empty_;
  std::shared_ptr<Request> message_;  // while gRPC reads into it
  PeerWait reading_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_READING_REACTOR_H_
