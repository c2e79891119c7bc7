#include "server/engine/item_run.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <utility>

#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

// How soon a stop request is noticed, and an item is offered again to a pool
// that was overloaded.
constexpr std::chrono::milliseconds kPause(20);

using Body = std::function<absl::StatusOr<ItemOutcome>(const std::string&)>;

class ItemRun {
 public:
  ItemRun(const std::vector<std::string>& items, const RunControl& control,
          const Body& body)
      : items_(items), control_(control), body_(body) {}

  absl::StatusOr<RunReport> Run(ComputePool& pool);

 private:
  void Submit(ComputePool& pool, size_t index);
  void Work(size_t index, const absl::Status& admission);
  void Count(size_t index, const absl::StatusOr<ItemOutcome>& outcome);
  RunReport TakeReport();

  const std::vector<std::string>& items_;
  const RunControl& control_;
  const Body& body_;

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<size_t> refused_;  // to be offered again
  int under_way_ = 0;
  absl::Status end_;  // why no further item is begun
  std::exception_ptr exception_;
  RunProgress progress_;
  RunReport report_;
  std::map<size_t, absl::Status> failures_;
};

void ItemRun::Count(size_t index, const absl::StatusOr<ItemOutcome>& outcome) {
  if (outcome.ok()) {
    ++(*outcome == ItemOutcome::kDone ? report_.done : report_.were_done);
  } else {
    ++report_.failed;
    failures_[index] = outcome.status();
    if (failures_.size() > kMaxListedFailures) {
      failures_.erase(std::prev(failures_.end()));
    }
  }
  ++progress_.done;
  progress_.failed = report_.failed;
  control_.report(progress_);
}

void ItemRun::Work(size_t index, const absl::Status& admission) {
  absl::StatusOr<ItemOutcome> outcome = ItemOutcome::kDone;
  std::exception_ptr exception;
  try {
    if (admission.ok()) outcome = body_(items_[index]);
  } catch (...) {
    exception = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  const absl::Status stopped = control_.stop.Check();
  if (exception != nullptr) {
    exception_ = exception;
    end_.Update(absl::InternalError("an exception"));
  } else if (admission.ok() && (outcome.ok() || stopped.ok())) {
    Count(index, outcome);
  } else if (ReasonOf(admission) == ErrorReason::kOverloaded) {
    refused_.push_back(index);
  } else {
    end_.Update(stopped.ok() ? admission : stopped);
  }
  --under_way_;
  // Under the lock: the run may be gone right after it.
  changed_.notify_all();
}

void ItemRun::Submit(ComputePool& pool, size_t index) {
  pool.Submit(
      WorkClass::kCompute, absl::InfiniteFuture(),
      [this, index](const absl::Status& admission) { Work(index, admission); });
}

absl::StatusOr<RunReport> ItemRun::Run(ComputePool& pool) {
  const int width = pool.Load(WorkClass::kCompute).threads;
  size_t next = 0;
  std::unique_lock lock(mutex_);
  progress_.items = static_cast<int64_t>(items_.size());
  control_.report(progress_);
  while (true) {
    const bool left = next < items_.size() || !refused_.empty();
    if (left) end_.Update(control_.stop.Check());
    if (under_way_ == 0 && (!left || !end_.ok())) break;
    if (!left || !end_.ok() || under_way_ >= width) {
      changed_.wait_for(lock, kPause);
      continue;
    }
    size_t index = next;
    if (refused_.empty()) {
      ++next;
    } else {
      index = refused_.back();
      refused_.pop_back();
      changed_.wait_for(lock, kPause);
    }
    ++under_way_;
    lock.unlock();
    Submit(pool, index);
    lock.lock();
  }
  if (exception_ != nullptr) std::rethrow_exception(exception_);
  ARGMESH_RETURN_IF_ERROR(end_);
  return TakeReport();
}

RunReport ItemRun::TakeReport() {
  for (auto& [index, status] : failures_) {
    report_.failures.push_back({items_[index], std::move(status)});
  }
  return std::move(report_);
}

}  // namespace

absl::StatusOr<RunReport> RunItems(ComputePool& pool,
                                   const std::vector<std::string>& items,
                                   const RunControl& control,
                                   const Body& body) {
  return ItemRun(items, control, body).Run(pool);
}

}  // namespace argmesh
