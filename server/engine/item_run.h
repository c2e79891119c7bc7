// Work on many items in the background: on threads of kCompute, several at a
// time, behind what calls wait for there.
//
// While the pool is overloaded an item waits. A failure is of its item and
// does not end the others.
#ifndef ARGMESH_SERVER_ENGINE_ITEM_RUN_H_
#define ARGMESH_SERVER_ENGINE_ITEM_RUN_H_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "server/engine/compute_pool.h"

namespace argmesh {

// How far a run is.
struct RunProgress {
  int64_t items = 0;
  int64_t done = 0;  // failed ones among them
  int64_t failed = 0;
};

// How a run is ended and watched.
struct RunControl {
  StopToken stop;
  // At the start and after every item, by one thread at a time.
  std::function<void(const RunProgress&)> report = [](const RunProgress&) {};
};

enum class ItemOutcome { kDone, kWasDone };

struct ItemFailure {
  std::string item;
  absl::Status status;
};

inline constexpr size_t kMaxListedFailures = 1000;

struct RunReport {
  int64_t done = 0;
  int64_t were_done = 0;  // before the run
  int64_t failed = 0;
  std::vector<ItemFailure> failures;  // the first of them, in the items' order
};

// Returns when nothing of it runs any more.
//
// Fails    kCancelled, kDeadlineExceeded  of `control.stop`: no item is begun
//                                         after that
//          kDraining                      the pool was closed
absl::StatusOr<RunReport> RunItems(
    ComputePool& pool, const std::vector<std::string>& items,
    const RunControl& control,
    const std::function<absl::StatusOr<ItemOutcome>(const std::string&)>& body);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_ITEM_RUN_H_
