// Which shapes of a collection contain a query: index, exact voting,
// verification, each for fewer shapes than the one before.
//
// Orientation  as given; when nothing is verified that way and the index votes
//              about as much for it, the query is tried turned inside out.
// Repeats      equal index, windows, query and options give equal bits,
//              whatever `parallel_for` does.
// Fails        what `load` fails with; kInvalidArgument for an option outside
//              its range; kCancelled, kDeadlineExceeded
// Memory       0.2 MB for each of `keep_limit` candidates, 1 MB a thread.
// Cost         index 10 ms + 25 us a shape, exact voting 1 ms for each of
//              `exact_limit`, verification 8 ms for each of `verify_limit` and
//              20 ms for each of `thorough_limit`, over the threads.
#ifndef ARGMESH_CORE_CONTAINMENT_CONTAINMENT_RANKING_H_
#define ARGMESH_CORE_CONTAINMENT_CONTAINMENT_RANKING_H_

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/stop_token.h"
#include "core/containment/containment_match.h"
#include "core/containment/window_index.h"
#include "core/containment/window_set.h"

namespace argmesh {

struct RankContainmentOptions {
  int limit = 10;           // matches returned, >= 1
  int exact_limit = 150;    // shapes whose windows are loaded, >= limit
  int verify_limit = 100;   // >= 1
  int thorough_limit = 20;  // >= 1
  // Shapes whose windows stay in memory between exact voting and verification,
  // the index's first; the others' are loaded again. >= 1
  int keep_limit = 256;
  bool try_flipped = true;
  uint64_t seed = 1;
  // As VoteOptions::slots: shapes that may be found, null for all.
  const std::vector<bool>* slots = nullptr;
};

struct RankedContainment {
  int64_t slot = 0;
  ContainmentMatch match;
  // Verified, and the query lies at other places of it as well, or it and the
  // first are verified with scores within 0.1: which place, or which of the
  // tied shapes the query is from cannot be told.
  bool tied = false;
};

struct ContainmentRanking {
  std::vector<RankedContainment> matches;  // by score, descending, then slot
  // The query fits too much to say anything: its windows are common
  // (distinctiveness < 0.28), or fairly common (< 0.4) while three shapes and
  // more than a tenth of those it was laid on hold it (F > 0.9). Then nothing
  // counts as found whatever `verified` says.
  bool generic = false;
  double distinctiveness = 0;  // 0 .. 1
  int64_t considered = 0;      // shapes in the index
  int64_t loaded = 0;          // whose windows were compared
  int64_t laid = 0;            // that the query was laid on
  absl::Duration index_time;
  absl::Duration exact_time;
  absl::Duration verify_time;
};

// The windows of a slot; called from any thread, for at most `exact_limit`
// slots, up to three times each. Null leaves a slot out that went since the
// index was read.
using LoadWindows =
    std::function<absl::StatusOr<std::shared_ptr<const TargetWindows>>(
        int64_t slot)>;

// Calls body(i) for every i in 0 .. count-1, on any threads, and returns when
// all are done.
using ParallelRunner = std::function<void(
    int64_t count, const std::function<void(int64_t)>& body)>;

// On the calling thread when `parallel_for` is empty.
absl::StatusOr<ContainmentRanking> RankContainment(
    const QueryWindows& query, const WindowIndex& index,
    const LoadWindows& load, const RankContainmentOptions& options = {},
    const ParallelRunner& parallel_for = {}, const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_CONTAINMENT_RANKING_H_
