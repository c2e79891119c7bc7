#include "server/engine/compute_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "absl/time/clock.h"
#include "server/engine/error_reason.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

ComputePoolOptions Threads(int threads, int max_queued) {
  ComputePoolOptions options;
  options.threads = {threads, threads, threads, threads};
  options.max_queued = {max_queued, max_queued, max_queued, max_queued};
  return options;
}

// Occupies one thread until released.
class Blocker {
 public:
  Blocker(ComputePool& pool, WorkClass work_class) {
    const auto begun = std::make_shared<std::promise<void>>();
    const std::shared_future<void> released = release_.get_future().share();
    pool.Submit(work_class, absl::InfiniteFuture(),
                [begun, released](const absl::Status& status) {
                  EXPECT_TRUE(status.ok());
                  begun->set_value();
                  released.wait();
                });
    begun->get_future().wait();
  }
  void Release() { release_.set_value(); }

 private:
  std::promise<void> release_;
};

absl::Status SubmitAndWait(ComputePool& pool, WorkClass work_class,
                           absl::Time deadline) {
  auto done = std::make_shared<std::promise<absl::Status>>();
  std::future<absl::Status> future = done->get_future();
  pool.Submit(work_class, deadline,
              [done](absl::Status status) { done->set_value(status); });
  return future.get();
}

TEST(ComputePool, RunsWorkOnAnotherThread) {
  std::promise<std::thread::id> id;
  ComputePool pool(Threads(1, 1));
  pool.Submit(WorkClass::kQuick, absl::InfiniteFuture(),
              [&](const absl::Status& status) {
                EXPECT_TRUE(status.ok());
                id.set_value(std::this_thread::get_id());
              });
  EXPECT_NE(id.get_future().get(), std::this_thread::get_id());
}

TEST(ComputePool, RunsWhatWaitsWhenAThreadComesFree) {
  std::atomic<int> ran{0};
  std::vector<std::promise<void>> done(5);
  ComputePool pool(Threads(1, 10));
  Blocker blocker(pool, WorkClass::kSearch);
  for (auto& promise : done) {
    pool.Submit(WorkClass::kSearch, absl::InfiniteFuture(),
                [&](const absl::Status& status) {
                  if (status.ok()) ++ran;
                  promise.set_value();
                });
  }
  EXPECT_EQ(pool.Load(WorkClass::kSearch).queued, 5);
  EXPECT_EQ(ran, 0);
  blocker.Release();
  for (auto& promise : done) promise.get_future().wait();
  EXPECT_EQ(ran, 5);
  EXPECT_EQ(pool.Load(WorkClass::kSearch).admitted, 6);
}

TEST(ComputePool, RefusesAtOnceWhenItsQueueIsFull) {
  ComputePool pool(Threads(1, 1));
  Blocker blocker(pool, WorkClass::kSearch);
  pool.Submit(WorkClass::kSearch, absl::InfiniteFuture(),
              [](const absl::Status&) {});
  const absl::Status refused =
      SubmitAndWait(pool, WorkClass::kSearch, absl::InfiniteFuture());
  EXPECT_EQ(ReasonOf(refused), ErrorReason::kOverloaded);
  EXPECT_TRUE(RetryDelayOf(refused).has_value());
  EXPECT_EQ(pool.Load(WorkClass::kSearch).refused, 1);
  blocker.Release();
}

TEST(ComputePool, LetsCallersTakeTurns) {
  std::mutex mutex;
  std::string order;
  std::vector<std::promise<void>> done(5);
  ComputePool pool(Threads(1, 10));
  Blocker blocker(pool, WorkClass::kSearch);
  const std::string callers = "aaabc";
  for (size_t i = 0; i < callers.size(); ++i) {
    const std::string caller(1, callers[i]);
    pool.Submit(
        WorkClass::kSearch, absl::InfiniteFuture(),
        [&, caller, i](const absl::Status&) {
          {
            const std::lock_guard lock(mutex);
            order += caller;
          }
          done[i].set_value();
        },
        caller);
  }
  blocker.Release();
  for (auto& promise : done) promise.get_future().wait();
  EXPECT_EQ(order, "abcaa");
}

TEST(ComputePool, LetsTheOneWithTheMostGoWhenItsQueueIsFull) {
  std::vector<std::string> ran;
  std::vector<std::string> refused;
  ComputePool pool(Threads(1, 3));
  Blocker blocker(pool, WorkClass::kSearch);
  std::mutex mutex;
  std::vector<std::promise<void>> done(6);
  const std::string callers = "aaabba";
  for (size_t i = 0; i < callers.size(); ++i) {
    pool.Submit(
        WorkClass::kSearch, absl::InfiniteFuture(),
        [&, i](const absl::Status& status) {
          {
            const std::lock_guard lock(mutex);
            (status.ok() ? ran : refused)
                .push_back(callers[i] + std::to_string(i));
          }
          done[i].set_value();
        },
        std::string(1, callers[i]));
  }
  blocker.Release();
  for (auto& promise : done) promise.get_future().wait();
  // The newest of "a" goes for the first of "b"; then both would have as many.
  EXPECT_THAT(ran, ElementsAre("a0", "b3", "a1"));
  // On threads of their own, in any order.
  EXPECT_THAT(refused, UnorderedElementsAre("a2", "b4", "a5"));
}

// Takes a lock when it goes.
struct LocksAtItsEnd {
  std::mutex& mutex;
  std::promise<void>& gone;
  ~LocksAtItsEnd() {
    { const std::lock_guard lock(mutex); }
    gone.set_value();
  }
};

TEST(ComputePool, LetsAnothersWorkGoOutsideOfSubmit) {
  std::mutex mutex;
  std::promise<void> gone;
  ComputePool pool(Threads(1, 2));
  Blocker blocker(pool, WorkClass::kSearch);
  const auto nothing = [](const absl::Status&) {};
  pool.Submit(WorkClass::kSearch, absl::InfiniteFuture(), nothing, "much");
  pool.Submit(
      WorkClass::kSearch, absl::InfiniteFuture(),
      [end = std::shared_ptr<LocksAtItsEnd>(new LocksAtItsEnd{mutex, gone})](
          const absl::Status& status) { EXPECT_FALSE(status.ok()); },
      "much");
  {
    const std::lock_guard lock(mutex);
    pool.Submit(WorkClass::kSearch, absl::InfiniteFuture(), nothing, "little");
  }
  gone.get_future().wait();
  blocker.Release();
}

TEST(ComputePool, RefusesWhatWaitedAQuarterOfItsTime) {
  ComputePool pool(Threads(1, 4));
  Blocker blocker(pool, WorkClass::kSearch);
  const absl::Time start = absl::Now();
  const absl::Status refused =
      SubmitAndWait(pool, WorkClass::kSearch, start + absl::Milliseconds(200));
  EXPECT_EQ(ReasonOf(refused), ErrorReason::kOverloaded);
  EXPECT_GE(absl::Now() - start, absl::Milliseconds(50));
  EXPECT_EQ(pool.Load(WorkClass::kSearch).queued, 0);
  blocker.Release();
}

TEST(ComputePool, KeepsItsClassesApart) {
  ComputePool pool(Threads(1, 0));
  Blocker compute(pool, WorkClass::kCompute);
  Blocker bulk(pool, WorkClass::kBulk);
  EXPECT_THAT(SubmitAndWait(pool, WorkClass::kSearch, absl::InfiniteFuture()),
              IsOk());
  EXPECT_THAT(SubmitAndWait(pool, WorkClass::kQuick, absl::InfiniteFuture()),
              IsOk());
  compute.Release();
  bulk.Release();
}

TEST(ComputePool, VisitsEveryIndexOfALoopOnce) {
  ComputePool pool(Threads(4, 4));
  for (const int64_t count : {int64_t{0}, int64_t{1}, int64_t{1000}}) {
    std::vector<std::atomic<int>> visits(static_cast<size_t>(count));
    pool.ParallelFor(WorkClass::kSearch, count,
                     [&](int64_t i) { ++visits[static_cast<size_t>(i)]; });
    for (const auto& visit : visits) EXPECT_EQ(visit, 1);
  }
  // Threads that came too late to help leave by themselves.
  while (pool.Load(WorkClass::kSearch).running > 0) std::this_thread::yield();
}

TEST(ComputePool, RunsALoopInsideWorkOfTheSameClassWhenNoThreadIsIdle) {
  std::promise<int64_t> sum;
  ComputePool pool(Threads(1, 4));
  pool.Submit(WorkClass::kSearch, absl::InfiniteFuture(),
              [&](const absl::Status&) {
                std::atomic<int64_t> total{0};
                pool.ParallelFor(WorkClass::kSearch, 10,
                                 [&](int64_t i) { total += i; });
                sum.set_value(total);
              });
  EXPECT_EQ(sum.get_future().get(), 45);
}

TEST(ComputePool, RefusesEverythingOnceItIsClosed) {
  std::promise<absl::Status> queued;
  ComputePool pool(Threads(1, 4));
  Blocker blocker(pool, WorkClass::kSearch);
  pool.Submit(WorkClass::kSearch, absl::InfiniteFuture(),
              [&](absl::Status status) { queued.set_value(status); });
  std::thread closing([&] { pool.Close(); });
  EXPECT_EQ(ReasonOf(queued.get_future().get()), ErrorReason::kDraining);
  blocker.Release();
  closing.join();
  EXPECT_EQ(
      ReasonOf(SubmitAndWait(pool, WorkClass::kQuick, absl::InfiniteFuture())),
      ErrorReason::kDraining);
  std::atomic<int> visits{0};
  pool.ParallelFor(WorkClass::kSearch, 10, [&](int64_t) { ++visits; });
  EXPECT_EQ(visits, 10);
}

TEST(ComputePool, CallsWhatIsSubmittedWhileItCloses) {
  constexpr int kPools = 200;
  std::atomic<int64_t> submitted{0};
  std::atomic<int64_t> called{0};
  for (int i = 0; i < kPools; ++i) {
    ComputePool pool(Threads(1, 1000));
    std::atomic<bool> closed{false};
    std::vector<std::thread> submitting;
    for (int n = 0; n < 8; ++n) {
      submitting.emplace_back([&] {
        while (!closed) {
          ++submitted;
          pool.Submit(WorkClass::kQuick, absl::InfiniteFuture(),
                      [&](const absl::Status& status) {
                        ++called;
                        if (ReasonOf(status) == ErrorReason::kDraining) {
                          closed = true;
                        }
                      });
        }
      });
    }
    const int64_t before = called;
    while (called < before + 100) std::this_thread::yield();
    pool.Close();
    for (std::thread& thread : submitting) thread.join();
  }
  EXPECT_EQ(called, submitted);
}

}  // namespace
}  // namespace argmesh
