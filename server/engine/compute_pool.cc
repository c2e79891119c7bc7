#include "server/engine/compute_pool.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#ifndef ASIO_STANDALONE
#define ASIO_STANDALONE
#endif
#include <asio/post.hpp>
#include <asio/steady_timer.hpp>
#include <asio/thread_pool.hpp>

#include "absl/time/clock.h"
#include "server/engine/cpu_count.h"
#include "server/engine/error_reason.h"
#include "server/engine/fair_queue.h"

namespace argmesh {
namespace {

constexpr int kLowNiceness = 5;

absl::Status Refusal(const char* why, absl::Duration retry_after) {
  return WithRetryDelay(MakeError(ErrorReason::kOverloaded, why), retry_after);
}

absl::Status DrainingError() {
  return WithRetryDelay(
      MakeError(ErrorReason::kDraining, "the server is shutting down"),
      absl::Seconds(1));
}

bool HasLowPriority(WorkClass work_class) {
  return work_class == WorkClass::kCompute || work_class == WorkClass::kBulk;
}

// Lowers the calling thread's priority; on Linux niceness is per thread. That
// it is refused somewhere only costs fairness.
void LowerPriorityOnce() {
  thread_local bool lowered = false;
  if (lowered) return;
  lowered = true;
  const auto thread = static_cast<id_t>(syscall(SYS_gettid));
  (void)setpriority(PRIO_PROCESS, thread, kLowNiceness);
}

// One ParallelFor, shared by the caller and the threads that join it.
struct ParallelLoop {
  int64_t count = 0;
  const std::function<void(int64_t)>* body = nullptr;
  std::atomic<int64_t> next{0};
  std::mutex mutex;
  std::condition_variable done;
  int joined = 0;
  bool closed = false;
};

}  // namespace

class ComputePool::State {
 public:
  explicit State(const ComputePoolOptions& options);

  void Submit(WorkClass work_class, absl::Time deadline, Work work,
              const std::string& caller);
  void ParallelFor(WorkClass work_class, int64_t count,
                   const std::function<void(int64_t)>& body);
  WorkLoad Load(WorkClass work_class) const;
  void Close();

 private:
  struct Lane {
    Lane(WorkClass lane_class, int num_threads, int queue_limit,
         asio::thread_pool& timers)
        : work_class(lane_class),
          max_queued(queue_limit),
          pool(static_cast<size_t>(num_threads)),
          timer(timers) {
      load.threads = num_threads;
    }
    const WorkClass work_class;
    const int max_queued;
    WorkLoad load;
    FairQueue<Work> queue;
    std::atomic<int> num_queued{0};  // a copy that helpers read unlocked
    asio::thread_pool pool;
    asio::steady_timer timer;
  };

  absl::Status TooManyWait() const {
    return Refusal("too many calls wait already", max_wait_);
  }
  // Locked; whether `caller` may wait, at the cost of another if need be.
  bool MakeRoom(Lane& lane, const std::string& caller);
  Lane& lane(WorkClass c) const { return *lanes_[static_cast<size_t>(c)]; }
  void Start(Lane& lane, Work work);  // locked; a thread is reserved
  void Serve(Lane& lane);             // takes what waits, frees the thread
  void ArmTimer(Lane& lane);          // locked
  void RefuseLate(Lane& lane);
  void Help(Lane& lane, ParallelLoop& loop);

  const absl::Duration max_wait_;
  mutable std::mutex mutex_;
  bool closed_ = false;
  asio::thread_pool timers_{1};
  std::vector<std::unique_ptr<Lane>> lanes_;
};

ComputePool::State::State(const ComputePoolOptions& options)
    : max_wait_(options.max_wait) {
  const auto defaults = ThreadsFor(AvailableCpus());
  for (size_t c = 0; c < kNumWorkClasses; ++c) {
    const int threads =
        options.threads[c] > 0 ? options.threads[c] : defaults[c];
    lanes_.push_back(std::make_unique<Lane>(static_cast<WorkClass>(c), threads,
                                            options.max_queued[c], timers_));
  }
}

void ComputePool::State::Submit(WorkClass work_class, absl::Time deadline,
                                Work work, const std::string& caller) {
  Lane& lane = this->lane(work_class);
  absl::Status refusal;
  {
    const std::lock_guard lock(mutex_);
    if (closed_) {
      refusal = DrainingError();
    } else if (lane.load.running < lane.load.threads && lane.queue.empty()) {
      ++lane.load.running;
      ++lane.load.admitted;
      Start(lane, std::move(work));
      return;
    } else if (MakeRoom(lane, caller)) {
      const absl::Time now = absl::Now();
      const absl::Duration quarter = (deadline - now) / 4;
      lane.queue.Push(
          caller, now + std::clamp(quarter, absl::ZeroDuration(), max_wait_),
          std::move(work));
      lane.num_queued = static_cast<int>(lane.queue.size());
      ArmTimer(lane);
      return;
    } else {
      refusal = TooManyWait();
    }
    ++lane.load.refused;
  }
  work(std::move(refusal));
}

bool ComputePool::State::MakeRoom(Lane& lane, const std::string& caller) {
  if (static_cast<int>(lane.queue.size()) < lane.max_queued) return true;
  Work pushed_out;
  if (!lane.queue.PushOut(caller, pushed_out)) return false;
  ++lane.load.refused;
  // Of another call: not on this thread, which may hold what it needs.
  asio::post(timers_, [this, pushed_out = std::move(pushed_out)]() mutable {
    std::exchange(pushed_out, nullptr)(TooManyWait());
  });
  return true;
}

// Locked, so that Close finds the thread reserved and its work posted, or
// neither: what is posted to a pool that has been joined never runs.
void ComputePool::State::Start(Lane& lane, Work work) {
  asio::post(lane.pool, [this, &lane, work = std::move(work)]() mutable {
    if (HasLowPriority(lane.work_class)) LowerPriorityOnce();
    // Gone, with what it holds, before the thread takes what waits.
    std::exchange(work, nullptr)(absl::OkStatus());
    Serve(lane);
  });
}

void ComputePool::State::Serve(Lane& lane) {
  while (true) {
    Work work;
    {
      const std::lock_guard lock(mutex_);
      if (lane.queue.empty()) {
        --lane.load.running;
        return;
      }
      work = lane.queue.Pop();
      lane.num_queued = static_cast<int>(lane.queue.size());
      ++lane.load.admitted;
    }
    work(absl::OkStatus());
  }
}

void ComputePool::State::ArmTimer(Lane& lane) {
  if (lane.queue.empty()) return;
  lane.timer.expires_after(absl::ToChronoNanoseconds(
      std::max(absl::ZeroDuration(), lane.queue.FirstGiveUp() - absl::Now())));
  lane.timer.async_wait([this, &lane](const asio::error_code& error) {
    if (!error) RefuseLate(lane);
  });
}

void ComputePool::State::RefuseLate(Lane& lane) {
  std::vector<Work> late;
  {
    const std::lock_guard lock(mutex_);
    late = lane.queue.TakeLate(absl::Now());
    lane.num_queued = static_cast<int>(lane.queue.size());
    lane.load.refused += static_cast<int64_t>(late.size());
    ArmTimer(lane);
  }
  for (const Work& work : late) {
    work(Refusal("no thread came free in time", max_wait_));
  }
}

void ComputePool::State::Help(Lane& lane, ParallelLoop& loop) {
  {
    const std::lock_guard lock(loop.mutex);
    if (loop.closed) return;
    ++loop.joined;
  }
  // A helper leaves when a call waits for its thread.
  while (lane.num_queued == 0) {
    const int64_t i = loop.next++;
    if (i >= loop.count) break;
    (*loop.body)(i);
  }
  const std::lock_guard lock(loop.mutex);
  --loop.joined;
  loop.done.notify_all();
}

void ComputePool::State::ParallelFor(WorkClass work_class, int64_t count,
                                     const std::function<void(int64_t)>& body) {
  Lane& lane = this->lane(work_class);
  const auto loop = std::make_shared<ParallelLoop>();
  loop->count = count;
  loop->body = &body;
  int helpers = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!closed_) {
      helpers = static_cast<int>(
          std::min<int64_t>(lane.load.threads - lane.load.running, count - 1));
      helpers = std::max(helpers, 0);
      lane.load.running += helpers;
    }
    for (int h = 0; h < helpers; ++h) {
      asio::post(lane.pool, [this, &lane, loop] {
        Help(lane, *loop);
        Serve(lane);
      });
    }
  }
  for (int64_t i = loop->next++; i < count; i = loop->next++) body(i);
  std::unique_lock lock(loop->mutex);
  loop->closed = true;
  loop->done.wait(lock, [&loop] { return loop->joined == 0; });
}

WorkLoad ComputePool::State::Load(WorkClass work_class) const {
  const std::lock_guard lock(mutex_);
  WorkLoad load = lane(work_class).load;
  load.queued = static_cast<int>(lane(work_class).queue.size());
  return load;
}

void ComputePool::State::Close() {
  std::vector<Work> refused;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    for (const auto& lane : lanes_) {
      for (Work& work : lane->queue.TakeLate(absl::InfiniteFuture())) {
        refused.push_back(std::move(work));
        ++lane->load.refused;
      }
      lane->num_queued = 0;
      lane->timer.cancel();
    }
  }
  for (const Work& work : refused) work(DrainingError());
  for (const auto& lane : lanes_) lane->pool.join();
  timers_.join();
}

std::array<int, kNumWorkClasses> ThreadsFor(int cpus) {
  const int most = std::max(1, cpus - 1);
  return {cpus, most, 2 * cpus, most};
}

ComputePool::ComputePool(const ComputePoolOptions& options)
    : state_(std::make_unique<State>(options)) {}

ComputePool::~ComputePool() { Close(); }

void ComputePool::Submit(WorkClass work_class, absl::Time deadline, Work work,
                         const std::string& caller) {
  state_->Submit(work_class, deadline, std::move(work), caller);
}

void ComputePool::ParallelFor(WorkClass work_class, int64_t count,
                              const std::function<void(int64_t)>& body) {
  state_->ParallelFor(work_class, count, body);
}

WorkLoad ComputePool::Load(WorkClass work_class) const {
  return state_->Load(work_class);
}

void ComputePool::Close() { state_->Close(); }

}  // namespace argmesh
