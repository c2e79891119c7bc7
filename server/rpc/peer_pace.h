// Whether a peer keeps up, who holds a place while its messages come: the time
// that it is waited for adds up, and each byte takes some of it away.
//
// Who is silent lags as long as that; who trickles, nearly; who sends at least
// kLeastBytesPerSecond on the average of late does not. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_PEER_PACE_H_
#define ARGMESH_SERVER_RPC_PEER_PACE_H_

#include <algorithm>
#include <cstdint>
#include <mutex>

#include "absl/time/time.h"

namespace argmesh {

inline constexpr int64_t kLeastBytesPerSecond = 1 << 10;

class PeerPace {
 public:
  explicit PeerPace(absl::Time begin) : last_tick_(begin) {}

  // So much of the peer's has come, or been taken by it.
  void Moved(int64_t bytes) {
    const std::lock_guard lock(mutex_);
    const double seconds =
        static_cast<double>(bytes) / static_cast<double>(kLeastBytesPerSecond);
    lag_ = std::max(absl::ZeroDuration(), lag_ - absl::Seconds(seconds));
  }

  // At every tick: how far the peer lags, who is waited for or not.
  absl::Duration Lag(absl::Time now, bool waited_for) {
    const std::lock_guard lock(mutex_);
    if (waited_for) lag_ += now - last_tick_;
    last_tick_ = now;
    return lag_;
  }

 private:
  std::mutex mutex_;
  absl::Time last_tick_;
  absl::Duration lag_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_PEER_PACE_H_
