// Cancellation and deadline of one piece of work, checked in every long loop.
//
// A default-made token never stops. Copies share their source. Thread-safe.
#ifndef ARGMESH_CORE_BASE_STOP_TOKEN_H_
#define ARGMESH_CORE_BASE_STOP_TOKEN_H_

#include <stop_token>
#include <utility>

#include "absl/status/status.h"
#include "absl/time/time.h"

namespace argmesh {

class StopToken {
 public:
  StopToken() = default;
  StopToken(std::stop_token stop, absl::Time deadline)
      : stop_(std::move(stop)), deadline_(deadline) {}

  absl::Time deadline() const { return deadline_; }

  // The same cancellation with the earlier of both deadlines.
  StopToken WithDeadline(absl::Time deadline) const;

  // kCancelled, kDeadlineExceeded or OK. About 50 ns: call it every few
  // thousand steps, and at least every 10 ms of work.
  absl::Status Check() const;

 private:
  std::stop_token stop_;
  absl::Time deadline_ = absl::InfiniteFuture();
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_STOP_TOKEN_H_
