#include "server/rpc/admission.h"

#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/time.h"
#include "server/engine/error_reason.h"

namespace argmesh {

Admission::Ticket& Admission::Ticket::operator=(Ticket&& other) noexcept {
  if (this != &other) {
    Release();
    used_ = std::exchange(other.used_, nullptr);
  }
  return *this;
}

void Admission::Ticket::Release() {
  if (used_ != nullptr) used_->fetch_sub(1);
  used_ = nullptr;
}

Admission::Admission(std::string what, int limit)
    : what_(std::move(what)), limit_(limit) {}

absl::StatusOr<Admission::Ticket> Admission::Admit() {
  // Taken first and given back when too many: never more than the limit hold
  // a ticket.
  const int limit = limit_;
  if (used_.fetch_add(1) < limit) return Ticket(&used_);
  used_.fetch_sub(1);
  return WithRetryDelay(
      MakeError(ErrorReason::kOverloaded,
                absl::StrFormat("%d %s are in flight, the limit", limit, what_),
                {{"limit", absl::StrFormat("%d", limit)}, {"what", what_}}),
      absl::Seconds(1));
}

}  // namespace argmesh
