// Which shapes of a collection contain a query's surface.
//
// Repeats  equal snapshot and query give equal rankings, whatever the threads.
// Fails    kCancelled, kDeadlineExceeded within 50 ms of the token's stop
#ifndef ARGMESH_SERVER_ENGINE_CONTAINMENT_RANKER_H_
#define ARGMESH_SERVER_ENGINE_CONTAINMENT_RANKER_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/sha256.h"
#include "core/base/stop_token.h"
#include "core/containment/containment_match.h"
#include "core/containment/window_set.h"
#include "core/matching/match.h"
#include "server/engine/catalog.h"
#include "server/engine/compute_pool.h"
#include "server/engine/gallery_snapshot.h"
#include "server/engine/search_requests.h"
#include "server/engine/slot_selection.h"

namespace argmesh {

struct ContainmentQuery {
  const QueryWindows& windows;
  const MatchableGraph& graph;  // of the same surface
  MatchOptions match;           // of graphs
  // Of the query's bytes: a shape of the same bytes holds it for certain.
  std::optional<Sha256Digest> sha256;
  int limit = 10;
  // Shapes whose windows are read and that the query is laid on; 0: as many as
  // pay, 150 and of them 100.
  int candidates = 0;
  bool exact = false;  // all of them
  double min_score = 0;
  double min_query_coverage = 0;
  const SlotSelection& slots;  // that may be found
};

struct ContainingShape {
  GalleryEntryPtr entry;  // null in a ContainmentPair
  double score = 0;       // ContainmentScore
  MatchResult graph;      // MatchPartial
  ContainmentMatch match;
  bool tied = false;
};

struct ContainmentAnswer {
  std::vector<ContainingShape> shapes;  // by score, descending, then by id
  // Then only a shape of the query's bytes is verified.
  bool generic = false;
  int64_t considered = 0;
  int64_t matched = 0;  // by their windows
  int64_t laid = 0;     // that the query was laid on
  int64_t damaged = 0;  // candidates whose windows cannot be read
  absl::Duration candidate_time;
  absl::Duration match_time;
  absl::Duration verification_time;
  absl::Duration graph_time;
};

// One query and one target, stored or not.
struct ContainmentPair {
  const QueryWindows& query;
  const MatchableGraph& query_graph;
  const TargetWindows& target;
  const MatchableGraph& target_graph;
  MatchOptions match;       // of graphs
  bool same_bytes = false;  // of the meshes
};

class ContainmentRanker {
 public:
  // Both must outlive it.
  ContainmentRanker(const Catalog& catalog, ComputePool& pool)
      : catalog_(catalog), pool_(pool) {}

  absl::StatusOr<ContainmentAnswer> Rank(const GallerySnapshot& gallery,
                                         const ContainmentQuery& query,
                                         const StopToken& stop) const;

  // What Rank would find of the target in a collection of its own.
  absl::StatusOr<ContainingShape> Match(const ContainmentPair& pair,
                                        const StopToken& stop) const;

 private:
  const Catalog& catalog_;
  ComputePool& pool_;
};

// S + 2 F^8 + .15 G, G being the graphs' partial score, as a share of its most,
// 0 .. 1. The weight of G was chosen on every second query of a labelled
// collection; between .1 and .3 little depends on it.
double ContainmentScore(const ContainmentMatch& match, double graph_score);
// The summands of that.
std::vector<ScoreTerm> ContainmentTerms(const ContainmentMatch& match,
                                        double graph_score);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_CONTAINMENT_RANKER_H_
