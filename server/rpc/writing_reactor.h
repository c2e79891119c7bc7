// The base of reactors that answer with a stream: one message after the other,
// made on the pool, and it is noticed when nobody takes them.
//
// Holds one message at a time.
#ifndef ARGMESH_SERVER_RPC_WRITING_REACTOR_H_
#define ARGMESH_SERVER_RPC_WRITING_REACTOR_H_

#include <mutex>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/rpc/guarded_reactor.h"
#include "server/rpc/peer_wait.h"

namespace argmesh {

// Of one message's chunk.
inline constexpr int64_t kDownloadChunkBytes = 256 << 10;

// `Base` is a GuardedReactor whose calls can write.
template <typename Response, typename Base>
class WritingReactor : public Base {
 public:
  using Base::Base;

  void OnWriteDone(bool ok) final {
    this->Guard([&] {
      writing_.End();
      if (!ok) {
        this->FinishOnce(absl::CancelledError("the client went away"));
        return;
      }
      this->RunPatiently(WorkClass::kQuick, [this] { SendNext(); });
    });
  }

  void OnTick(absl::Time now) final {
    Base::OnTick(now);
    this->ResubmitWaiting();
    // A write that nobody takes blocks the end of the call too: only a
    // cancellation gets through.
    if (writing_.Lasted(now) > this->environment().stream_idle_timeout()) {
      this->scope().context()->TryCancel();
    }
  }

 protected:
  // Makes the next message, on the pool; false when there is none.
  virtual absl::StatusOr<bool> Continue(Response& next) = 0;

  // Once, on the pool: the first message; the others follow.
  void SendNext() {
    const absl::StatusOr<bool> more = Continue(response_);
    if (more.ok() && *more) {
      Send();
    } else {
      this->FinishOnce(more.status());
    }
  }

 private:
  void Send() {
    const std::lock_guard lock(this->scope().mutex());
    if (this->scope().finished()) return;
    writing_.Begin();
    this->StartWrite(&response_);
  }

  Response response_;
  PeerWait writing_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_WRITING_REACTOR_H_
