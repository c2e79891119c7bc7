#include "client/backoff.h"

#include <algorithm>

#include "client/error_status.h"

namespace argmesh {

Backoff::Backoff(const RetryOptions& options, uint64_t seed)
    : options_(options), random_(seed), backoff_(options.initial_backoff) {}

std::optional<absl::Duration> Backoff::Next(const absl::Status& failure) {
  if (!IsRetryable(failure)) return std::nullopt;
  if (++failures_ >= options_.max_attempts) return std::nullopt;
  const absl::Duration wait = backoff_ * random_.Uniform(0.5, 1.0);
  backoff_ = std::min(backoff_ * options_.multiplier, options_.max_backoff);
  return std::max(wait, RetryDelay(failure));
}

void Backoff::Reset() {
  failures_ = 0;
  backoff_ = options_.initial_backoff;
}

}  // namespace argmesh
