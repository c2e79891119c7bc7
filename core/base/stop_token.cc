#include "core/base/stop_token.h"

#include <algorithm>

#include "absl/time/clock.h"

namespace argmesh {

StopToken StopToken::WithDeadline(absl::Time deadline) const {
  return StopToken(stop_, std::min(deadline_, deadline));
}

absl::Status StopToken::Check() const {
  if (deadline_ != absl::InfiniteFuture() && absl::Now() >= deadline_) {
    return absl::DeadlineExceededError("the deadline has passed");
  }
  if (stop_.stop_requested()) return absl::CancelledError("cancelled");
  return absl::OkStatus();
}

}  // namespace argmesh
