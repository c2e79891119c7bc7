#include "server/rpc/admission.h"

#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/time.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

constexpr int kPlacesForOneOfOthers = 4;

}  // namespace

Admission::Ticket::Ticket(Ticket&& other) noexcept
    : admission_(std::exchange(other.admission_, nullptr)),
      peer_(std::move(other.peer_)) {}

Admission::Ticket& Admission::Ticket::operator=(Ticket&& other) noexcept {
  if (this != &other) {
    Release();
    admission_ = std::exchange(other.admission_, nullptr);
    peer_ = std::move(other.peer_);
  }
  return *this;
}

void Admission::Ticket::Release() {
  if (admission_ != nullptr) std::exchange(admission_, nullptr)->Leave(peer_);
}

Admission::Admission(std::string what, int limit)
    : what_(std::move(what)), limit_(limit) {}

absl::StatusOr<Admission::Ticket> Admission::Admit(const std::string& peer) {
  const int limit = limit_;
  const int shared = limit - limit / kPlacesForOneOfOthers;
  {
    std::string name = peer;
    const std::lock_guard lock(mutex_);
    if (used_ < (peers_.contains(peer) ? shared : limit)) {
      ++peers_[peer];  // first: it may throw
      ++used_;
      return Ticket(*this, std::move(name));
    }
  }
  return WithRetryDelay(
      MakeError(ErrorReason::kOverloaded,
                absl::StrFormat("too many %s are in flight: the limit is %d, "
                                "of which %d are for connections without any",
                                what_, limit, limit - shared),
                {{"limit", absl::StrFormat("%d", limit)}, {"what", what_}}),
      absl::Seconds(1));
}

int Admission::used() const {
  const std::lock_guard lock(mutex_);
  return used_;
}

void Admission::Leave(const std::string& peer) {
  const std::lock_guard lock(mutex_);
  --used_;
  const auto calls = peers_.find(peer);
  if (--calls->second == 0) peers_.erase(calls);
}

}  // namespace argmesh
