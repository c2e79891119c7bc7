#include "server/rpc/call_registry.h"

#include "absl/time/clock.h"
#include "server/rpc/status.h"

namespace argmesh {

CallRegistry::CallRegistry(absl::Duration tick)
    : tick_(tick), ticker_([this] { RunTicks(); }) {}

CallRegistry::~CallRegistry() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  ticker_.join();
}

absl::Status CallRegistry::Enter(LiveCall* call) {
  const std::lock_guard lock(mutex_);
  calls_.insert(call);
  return draining_ ? ServerDraining() : absl::OkStatus();
}

void CallRegistry::Leave(LiveCall* call) {
  const std::lock_guard lock(mutex_);
  calls_.erase(call);
  // Under the lock: the registry may be gone right after it.
  changed_.notify_all();
}

void CallRegistry::Hold() {
  const std::lock_guard lock(mutex_);
  ++held_;
}

void CallRegistry::Release() {
  const std::lock_guard lock(mutex_);
  --held_;
  changed_.notify_all();
}

int CallRegistry::in_flight() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(calls_.size());
}

bool CallRegistry::draining() const {
  const std::lock_guard lock(mutex_);
  return draining_;
}

void CallRegistry::StartDrain(absl::Duration grace) {
  const std::lock_guard lock(mutex_);
  if (draining_) return;
  draining_ = true;
  // Under the lock, so that no call leaves while it is told.
  for (LiveCall* call : calls_) call->OnDrain(grace);
}

bool CallRegistry::WaitUntilIdle(absl::Time deadline) {
  std::unique_lock lock(mutex_);
  return changed_.wait_until(lock, absl::ToChronoTime(deadline),
                             [this] { return calls_.empty() && held_ == 0; });
}

void CallRegistry::RunTicks() {
  std::unique_lock lock(mutex_);
  while (!stopped_) {
    changed_.wait_for(lock, absl::ToChronoMilliseconds(tick_),
                      [this] { return stopped_; });
    if (stopped_) return;
    const absl::Time now = absl::Now();
    for (LiveCall* call : calls_) call->OnTick(now);
  }
}

}  // namespace argmesh
