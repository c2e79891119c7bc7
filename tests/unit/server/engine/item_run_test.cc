#include "server/engine/item_run.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <set>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/engine/error_reason.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

std::vector<std::string> Items(int count) {
  std::vector<std::string> items;
  for (int i = 0; i < count; ++i) items.push_back(std::to_string(i));
  return items;
}

ComputePoolOptions Threads(int compute) {
  ComputePoolOptions options;
  options.threads = {1, compute, 1, 1};
  return options;
}

TEST(RunItems, DoesEveryItemOnceAndTellsHowFarItIs) {
  ComputePool pool(Threads(3));
  std::mutex mutex;
  std::multiset<std::string> seen;
  std::vector<RunProgress> progress;
  RunControl control;
  control.report = [&](const RunProgress& p) { progress.push_back(p); };
  ASSERT_OK_AND_ASSIGN(
      const RunReport report,
      RunItems(pool, Items(100), control,
               [&](const std::string& item) -> absl::StatusOr<ItemOutcome> {
                 const std::lock_guard lock(mutex);
                 seen.insert(item);
                 return item.size() == 1 ? ItemOutcome::kWasDone
                                         : ItemOutcome::kDone;
               }));
  EXPECT_EQ(seen.size(), 100U);
  EXPECT_EQ(std::set<std::string>(seen.begin(), seen.end()).size(), 100U);
  EXPECT_EQ(report.done, 90);
  EXPECT_EQ(report.were_done, 10);
  EXPECT_EQ(report.failed, 0);
  ASSERT_EQ(progress.size(), 101U);
  for (size_t i = 0; i < progress.size(); ++i) {
    EXPECT_EQ(progress[i].items, 100);
    EXPECT_EQ(progress[i].done, static_cast<int64_t>(i));
  }
}

TEST(RunItems, ListsFailuresInTheItemsOrderAndGoesOn) {
  ComputePool pool(Threads(3));
  ASSERT_OK_AND_ASSIGN(
      const RunReport report,
      RunItems(pool, Items(2000), {},
               [](const std::string& item) -> absl::StatusOr<ItemOutcome> {
                 if (item == "1999") return ItemOutcome::kDone;
                 return MakeError(ErrorReason::kMeshEmpty, item);
               }));
  EXPECT_EQ(report.done, 1);
  EXPECT_EQ(report.failed, 1999);
  ASSERT_EQ(report.failures.size(), kMaxListedFailures);
  for (size_t i = 0; i < report.failures.size(); ++i) {
    EXPECT_EQ(report.failures[i].item, std::to_string(i));
    EXPECT_EQ(report.failures[i].status.message(), std::to_string(i));
  }
}

TEST(RunItems, BeginsNothingAfterAStopRequest) {
  ComputePool pool(Threads(1));
  std::stop_source source;
  RunControl control;
  control.stop = StopToken(source.get_token(), absl::InfiniteFuture());
  std::atomic<int> begun = 0;
  const auto report =
      RunItems(pool, Items(100), control,
               [&](const std::string&) -> absl::StatusOr<ItemOutcome> {
                 if (++begun == 3) source.request_stop();
                 return ItemOutcome::kDone;
               });
  EXPECT_EQ(report.status().code(), absl::StatusCode::kCancelled);
  EXPECT_EQ(begun, 3);
}

TEST(RunItems, IsCancelledByAnItemThatWasStoppedAndCountsNoFailure) {
  ComputePool pool(Threads(1));
  std::stop_source source;
  RunControl control;
  control.stop = StopToken(source.get_token(), absl::InfiniteFuture());
  int64_t failed = 0;
  control.report = [&](const RunProgress& p) { failed = p.failed; };
  const auto report =
      RunItems(pool, Items(3), control,
               [&](const std::string&) -> absl::StatusOr<ItemOutcome> {
                 source.request_stop();
                 return control.stop.Check();
               });
  EXPECT_EQ(report.status().code(), absl::StatusCode::kCancelled);
  EXPECT_EQ(failed, 0);
}

TEST(RunItems, WaitsForAPoolThatIsOverloaded) {
  ComputePoolOptions options = Threads(1);
  options.max_queued = {1, 1, 1, 1};
  options.max_wait = absl::Milliseconds(1);
  ComputePool pool(options);
  // The only thread is held until an item has been refused.
  std::mutex mutex;
  std::condition_variable changed;
  bool refused = false;
  pool.Submit(WorkClass::kCompute, absl::InfiniteFuture(),
              [&](const absl::Status&) {
                std::unique_lock lock(mutex);
                changed.wait(lock, [&] { return refused; });
              });
  std::thread watch([&] {
    while (pool.Load(WorkClass::kCompute).refused == 0) {
      std::this_thread::yield();
    }
    const std::lock_guard lock(mutex);
    refused = true;
    changed.notify_all();
  });
  const auto report =
      RunItems(pool, Items(5), {},
               [](const std::string&) -> absl::StatusOr<ItemOutcome> {
                 return ItemOutcome::kDone;
               });
  watch.join();
  ASSERT_THAT(report, IsOk());
  EXPECT_EQ(report->done, 5);
}

TEST(RunItems, SaysThatThePoolIsClosed) {
  ComputePool pool(Threads(1));
  pool.Close();
  const auto report =
      RunItems(pool, Items(5), {},
               [](const std::string&) -> absl::StatusOr<ItemOutcome> {
                 return ItemOutcome::kDone;
               });
  EXPECT_EQ(ReasonOf(report.status()), ErrorReason::kDraining);
}

TEST(RunItems, ThrowsWhatAnItemThrew) {
  ComputePool pool(Threads(2));
  const auto run = [&] {
    return RunItems(pool, Items(5), {},
                    [](const std::string&) -> absl::StatusOr<ItemOutcome> {
                      throw std::runtime_error("broken");
                    });
  };
  EXPECT_THROW((void)run(), std::runtime_error);
}

TEST(RunItems, HasNothingToDoWithoutItems) {
  ComputePool pool(Threads(1));
  ASSERT_OK_AND_ASSIGN(const RunReport report, RunItems(pool, {}, {}, nullptr));
  EXPECT_EQ(report.done + report.were_done + report.failed, 0);
}

}  // namespace
}  // namespace argmesh
