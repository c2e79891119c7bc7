// Seam: which shapes of a collection are most like a query.
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

namespace argmesh {

struct RankQuery {
  const MatchableGraph& graph;
  MatchMode mode = MatchMode::kGlobal;
  AttributeSet attributes = AttributeSet::kFull;
  int limit = 10;
  double min_score = 0;
  double min_query_coverage = 0;
  std::string exclude_id;  // of the collection; empty: none
};

struct RankedShape {
  GalleryEntryPtr entry;
  double score = 0;
};

struct Ranking {
  std::vector<RankedShape> shapes;  // by score, descending, then by id
  int64_t considered = 0;
  int64_t matched = 0;
  bool exhaustive = true;  // every entry was matched
};

class ShapeRanker {
 public:
  virtual ~ShapeRanker() = default;
  virtual absl::StatusOr<Ranking> Rank(const GallerySnapshot& gallery,
                                       const RankQuery& query,
                                       const StopToken& stop) const = 0;
};

// Matches every shape on the pool's search threads. `pool` must outlive it.
std::unique_ptr<ShapeRanker> MakeExactRanker(ComputePool& pool);

MatchResult MatchGraphs(MatchMode mode, const MatchableGraph& query,
                        const MatchableGraph& target,
                        const MatchOptions& options);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SHAPE_RANKER_H_
