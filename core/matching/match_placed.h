// Which components correspond where a query lies on a target: by place, not by
// likeness.
//
// Two components correspond as far as they lie on each other: the area they
// share over the area of both, where of the target only what the query lies on
// counts. At each pair of levels the assignment of the largest sum; of the
// levels the pair whose shares, weighted by area, are largest. The finest is
// taken that comes within a tenth of it.
//
// Cost     O(samples x levels^2), about 1 ms. Thread-safe.
#ifndef ARGMESH_CORE_MATCHING_MATCH_PLACED_H_
#define ARGMESH_CORE_MATCHING_MATCH_PLACED_H_

#include <array>
#include <cstdint>
#include <span>

#include "core/graph/shape_graph.h"
#include "core/matching/match.h"

namespace argmesh {

struct LabelledGraph {
  const ShapeGraph& graph;
  const FaceLabels& labels;  // of the faces of its mesh
};

// Puts the levels and pairs of `match` in place of what it has; NodePair's
// similarity is the share above, at least a tenth. `overlaid`: {face of the
// query, face of the target or -1}, an equal share of the query's area each.
// Changes nothing when no labelled face lies on a labelled face. Levels of one
// node count only when the query has no other; uniform cells do not.
void MatchPlaced(const LabelledGraph& query, const LabelledGraph& target,
                 std::span<const std::array<int32_t, 2>> overlaid,
                 const MatchOptions& options, MatchResult& match);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_MATCH_PLACED_H_
