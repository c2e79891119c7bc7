// The waits between the attempts of one call.
#ifndef ARGMESH_CLIENT_BACKOFF_H_
#define ARGMESH_CLIENT_BACKOFF_H_

#include <cstdint>
#include <optional>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "client/client_options.h"
#include "core/base/random.h"

namespace argmesh {

class Backoff {
 public:
  // `seed` drives the random half of each wait.
  Backoff(const RetryOptions& options, uint64_t seed);

  // How long to wait after `failure` before the next attempt; nothing when the
  // attempts are used up or another attempt cannot help.
  std::optional<absl::Duration> Next(const absl::Status& failure);

  // Counts attempts from the start again: something got through.
  void Reset();

 private:
  RetryOptions options_;
  Random random_;
  int failures_ = 0;
  absl::Duration backoff_;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_BACKOFF_H_
