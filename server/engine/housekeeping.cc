#include "server/engine/housekeeping.h"

#include <algorithm>

#include "absl/time/clock.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr absl::Duration kFirstRetry = absl::Seconds(1);
constexpr absl::Duration kLastRetry = absl::Minutes(5);
constexpr absl::Duration kNothingToDo = absl::Hours(1);

// When something that failed is tried again: ever more seldom.
class Retry {
 public:
  bool IsDue() const { return failed_ && absl::Now() >= at_; }
  void Done(bool well) {
    failed_ = !well;
    at_ = absl::Now() + next_;
    next_ = well ? kFirstRetry : std::min(2 * next_, kLastRetry);
  }
  absl::Duration wait() const {
    return failed_ ? std::max(at_ - absl::Now(), absl::ZeroDuration())
                   : kNothingToDo;
  }

 private:
  bool failed_ = true;  // what was never done is due
  absl::Duration next_ = kFirstRetry;
  absl::Time at_ = absl::InfinitePast();
};

}  // namespace

void Housekeeping::Start() {
  thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
}

void Housekeeping::Wake() {
  const std::lock_guard lock(mutex_);
  woken_ = true;
  wake_.notify_one();
}

void Housekeeping::Stop() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
}

void Housekeeping::Run(const std::stop_token& stop) {
  const StopToken token(stop, absl::InfiniteFuture());
  gallery_.Load(token);
  Sweep(token);
  Retry load;
  Retry removal;
  while (!stop.stop_requested()) {
    if (load.IsDue()) load.Done(gallery_.LoadMissing(token));
    const absl::Time begin = absl::Now();
    const absl::StatusOr<bool> more = RemoveSome();
    removal.Done(more.ok());
    absl::Duration pause = std::min(load.wait(), removal.wait());
    // Others write as long as this did.
    if (more.ok() && *more) pause = absl::Now() - begin;
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, stop, absl::ToChronoMilliseconds(pause),
                   [this] { return woken_; });
    woken_ = false;
  }
}

// Nothing waits for it; what it leaves goes at the next start.
void Housekeeping::Sweep(const StopToken& stop) {
  (void)catalog_.ForgetChanges(stop);
  (void)catalog_.RemoveUnusedGraphs(stop);
  (void)meshes_.Sweep(
      absl::Now() - sweep_age_,
      [this, &stop](const Sha256Digest& sha256) -> absl::StatusOr<bool> {
        ARGMESH_RETURN_IF_ERROR(stop.Check());
        return catalog_.IsMeshReferenced(sha256);
      });
}

absl::StatusOr<bool> Housekeeping::RemoveSome() {
  ARGMESH_ASSIGN_OR_RETURN(const RemovedShapes removed,
                           catalog_.RemoveSomeDeleted());
  ingest_.RemoveMeshes(removed.unreferenced);
  return removed.more;
}

}  // namespace argmesh
