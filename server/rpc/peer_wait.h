// Since when something of a peer is waited for: a message that has not come
// whole, or an answer that has not been taken. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_PEER_WAIT_H_
#define ARGMESH_SERVER_RPC_PEER_WAIT_H_

#include <atomic>
#include <cstdint>

#include "absl/time/clock.h"
#include "absl/time/time.h"

namespace argmesh {

class PeerWait {
 public:
  void Begin(absl::Time since = absl::Now()) {
    since_ms_ = absl::ToUnixMillis(since);
  }
  void End() { since_ms_ = kNone; }

  bool pending() const { return since_ms_ != kNone; }
  // Zero when nothing is waited for.
  absl::Duration Lasted(absl::Time now) const {
    const int64_t since = since_ms_;
    return since == kNone ? absl::ZeroDuration()
                          : now - absl::FromUnixMillis(since);
  }

 private:
  static constexpr int64_t kNone = -1;

  std::atomic<int64_t> since_ms_{kNone};
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_PEER_WAIT_H_
