// Seam: which shapes of a collection are most like a query, as wholes or by
// their graphs.
//
// Repeats  equal snapshot and query give equal rankings, whatever the threads.
// Fails    kCancelled, kDeadlineExceeded within 50 ms of the token's stop
#ifndef ARGMESH_SERVER_ENGINE_SHAPE_RANKER_H_
#define ARGMESH_SERVER_ENGINE_SHAPE_RANKER_H_

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/matching/match.h"
#include "server/engine/compute_pool.h"
#include "server/engine/gallery_snapshot.h"
#include "server/engine/search_requests.h"
#include "server/engine/slot_selection.h"

namespace argmesh {

struct RankQuery {
  const MatchableGraph& graph;
  MatchMode mode = MatchMode::kGlobal;
  MatchOptions match;  // but `correspondence`
  // Null: by the graphs alone.
  const PackedSignature* signature = nullptr;
  int candidates = 0;  // graphs to be matched; 0: as many as pay
  bool exact = false;  // all graphs
  int limit = 10;
  double min_score = 0;
  double min_query_coverage = 0;
  const SlotSelection& slots;  // that may be found
};

struct RankedShape {
  GalleryEntryPtr entry;
  double score = 0;
  double signature = 0;        // similarity, where there is one
  int32_t candidate_rank = 0;  // by signature, from 1; 0: all are candidates
};

struct Ranking {
  std::vector<RankedShape> shapes;  // by score, descending, then by id
  int64_t considered = 0;
  int64_t matched = 0;
  bool exhaustive = true;  // every one considered was matched
};

class ShapeRanker {
 public:
  virtual ~ShapeRanker() = default;
  virtual absl::StatusOr<Ranking> Rank(const GallerySnapshot& gallery,
                                       const RankQuery& query,
                                       const StopToken& stop) const = 0;
};

// On the pool's search threads: all signatures, then the graphs of the best
// candidates. `pool` must outlive it.
std::unique_ptr<ShapeRanker> MakeTwoStageRanker(ComputePool& pool);

MatchResult MatchGraphs(MatchMode mode, const MatchableGraph& query,
                        const MatchableGraph& target,
                        const MatchOptions& options);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SHAPE_RANKER_H_
