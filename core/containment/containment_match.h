// Whether and where one shape contains a query: a similarity transform that
// lays the query's surface on the target's.
//
// Pairs of matching windows give transforms, the best are refined point to
// plane, and the share of the query that lies on the target within 2 % of its
// size is F. Proper rotations only: a mirrored copy is another shape.
//
// Repeats  equal query, target and options give equal bits.
// Fails    kCancelled, kDeadlineExceeded within 20 ms of the token's stop
// Cost     6 ms, or 18 ms when thorough. Thread-safe.
#ifndef ARGMESH_CORE_CONTAINMENT_CONTAINMENT_MATCH_H_
#define ARGMESH_CORE_CONTAINMENT_CONTAINMENT_MATCH_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/containment/prepared_target.h"
#include "core/containment/window_set.h"
#include "core/containment/window_votes.h"

namespace argmesh {

struct ContainmentMatch {
  double votes = 0;         // S, 0 .. 1
  double coarse_cover = 0;  // C: the share within 6 % of the query's size
  double fine_cover = 0;    // F: the share within 2 %
  double score = 0;         // S + 2 F^8, 0 .. 3
  // The whole query lies on the target: F >= 0.95. Says nothing about a query
  // that is too generic (see ContainmentRanking).
  bool verified = false;
  bool flipped = false;  // the query was turned inside out
  // Homogeneous, from the query's own units to the target's own units;
  // identity while no transform was found (coarse_cover == 0).
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
  // Where else the query lies, as `transform`; see FindOtherPlaces.
  std::vector<Eigen::Matrix4d> other_places;
  double query_coverage = 0;  // share of the query's area on the target, 0 .. 1
  double target_coverage = 0;  // share of the target's area under the query
};

struct VerifyOptions {
  bool thorough = true;  // 900 transforms tried, not 150; 8 refined, not 3
  bool flipped = false;
  uint64_t seed = 1;
  // VoteResult::weights of the query; empty: every window weighs the same.
  std::span<const float> weights = {};
};

// `votes` are those of this target; its best three shifts are tried.
absl::StatusOr<ContainmentMatch> VerifyContainment(
    const QueryWindows& query, const PreparedTarget& target,
    const ShapeVotes& votes, const VerifyOptions& options = {},
    const StopToken& stop = {});

inline constexpr size_t kMaxOtherPlaces = 15;

// Places of the target on which the query lies as well as on `match`, which is
// verified there: legs of a table. Their middles are at least 0.3 of the
// query's size apart, and F is at most 0.05 less than the match's. Best first;
// turns of the query about its own middle are no other places.
//
// Fails, Repeats  as VerifyContainment. Cost 20 ms.
absl::StatusOr<std::vector<Eigen::Matrix4d>> FindOtherPlaces(
    const QueryWindows& query, const PreparedTarget& target,
    const ShapeVotes& votes, const ContainmentMatch& match,
    const VerifyOptions& options = {}, const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_CONTAINMENT_MATCH_H_
