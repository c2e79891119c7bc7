// The base of reactors that read a stream: one message after the other, and
// it is noticed when none comes. The caller's rights are checked for every
// message.
#ifndef ARGMESH_SERVER_RPC_READING_REACTOR_H_
#define ARGMESH_SERVER_RPC_READING_REACTOR_H_

#include <atomic>
#include <cstdint>
#include <mutex>

#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "server/rpc/guarded_reactor.h"

namespace argmesh {

// `Base` is grpc::ServerReadReactor<Request> or a ServerBidiReactor.
template <typename Base, typename Request>
class ReadingReactor : public GuardedReactor<Base> {
 public:
  using GuardedReactor<Base>::GuardedReactor;

  void OnReadDone(bool ok) final {
    reading_since_.store(kNotReading);
    this->Guard([&] {
      if (!ok) {
        ReadsEnded();
      } else if (absl::Status status = this->scope().AuthorizeMessage(request_);
                 !status.ok()) {
        this->FinishOnce(status);
      } else {
        Received(request_);
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
    request_.Clear();
    reading_since_.store(absl::ToUnixMillis(absl::Now()));
    this->StartRead(&request_);
  }

  // How long the client has been silent while a message of it was waited for.
  absl::Duration Silence(absl::Time now) const {
    const int64_t since = reading_since_.load();
    return since == kNotReading ? absl::ZeroDuration()
                                : now - absl::FromUnixMillis(since);
  }

 private:
  static constexpr int64_t kNotReading = -1;

  Request request_;
  std::atomic<int64_t> reading_since_{kNotReading};
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_READING_REACTOR_H_
