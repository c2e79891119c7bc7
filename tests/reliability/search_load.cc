#include "tests/reliability/search_load.h"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "absl/synchronization/mutex.h"
#include "tests/reliability/small_service.h"

namespace argmesh {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kConnections = 4;
constexpr auto kDeadline = std::chrono::seconds(20);

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

double LoadOutcome::answered_per_second() const {
  return seconds > 0 ? static_cast<double>(milliseconds.size()) / seconds : 0;
}

// What the calls of one load came to. Thread-safe.
class SearchLoad::Tally {
 public:
  void Begin() {
    const absl::MutexLock lock(&mutex_);
    ++open_;
  }

  void End(const grpc::Status& status, double milliseconds) {
    const absl::MutexLock lock(&mutex_);
    if (status.ok()) {
      outcome_.milliseconds.push_back(milliseconds);
    } else if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED) {
      ++outcome_.refused;
    } else if (++outcome_.failed == 1) {
      outcome_.failure = FailureOf(status);
    }
    --open_;
  }

  // Waits until no call is open.
  LoadOutcome Take() {
    const absl::MutexLock lock(&mutex_);
    mutex_.Await(absl::Condition(
        +[](int* open) { return *open == 0; }, &open_));
    outcome_.seconds = SecondsSince(begin_);
    std::sort(outcome_.milliseconds.begin(), outcome_.milliseconds.end());
    return std::move(outcome_);
  }

 private:
  const Clock::time_point begin_ = Clock::now();
  absl::Mutex mutex_;
  int open_ = 0;
  LoadOutcome outcome_;
};

SearchLoad::SearchLoad(const std::string& address,
                       v1::SearchShapesRequest request)
    : request_(std::move(request)) {
  for (int i = 0; i < kConnections; ++i) {
    stubs_.push_back(v1::SearchService::NewStub(OwnChannel(address)));
  }
}

SearchLoad::~SearchLoad() = default;

LoadOutcome SearchLoad::Closed(int callers, std::chrono::milliseconds time) {
  const auto end = Clock::now() + time;
  Tally tally;
  std::vector<std::thread> threads;
  for (int i = 0; i < callers; ++i) {
    threads.emplace_back([&, i] {
      while (Clock::now() < end) {
        tally.Begin();
        const auto begin = Clock::now();
        grpc::ClientContext context;
        context.set_deadline(std::chrono::system_clock::now() + kDeadline);
        v1::SearchShapesResponse response;
        const grpc::Status status =
            stubs_[static_cast<size_t>(i) % stubs_.size()]->SearchShapes(
                &context, request_, &response);
        tally.End(status, 1e3 * SecondsSince(begin));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  return tally.Take();
}

LoadOutcome SearchLoad::Open(double calls_per_second,
                             std::chrono::milliseconds time) {
  struct Call {
    grpc::ClientContext context;
    v1::SearchShapesResponse response;
    Clock::time_point begin = Clock::now();
  };
  const auto begin = Clock::now();
  const auto calls = static_cast<int64_t>(calls_per_second * 1e-3 *
                                          static_cast<double>(time.count()));
  Tally tally;
  for (int64_t i = 0; i < calls; ++i) {
    std::this_thread::sleep_until(
        begin + std::chrono::duration_cast<Clock::duration>(
                    std::chrono::duration<double>(static_cast<double>(i) /
                                                  calls_per_second)));
    auto* call = new Call;
    call->context.set_deadline(std::chrono::system_clock::now() + kDeadline);
    tally.Begin();
    stubs_[static_cast<size_t>(i) % stubs_.size()]->async()->SearchShapes(
        &call->context, &request_, &call->response,
        [call, &tally](const grpc::Status& status) {
          const double took = 1e3 * SecondsSince(call->begin);
          delete call;
          tally.End(status, took);
        });
  }
  return tally.Take();
}

}  // namespace argmesh
