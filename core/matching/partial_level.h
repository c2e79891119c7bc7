// How well one level of a query is found inside one level of a target.
//
// Every query node is assigned a target node of its own, by attributes that
// survive cutting and unknown scale. Nodes of similarity at least
// kMinPartialSimilarity count as found:
//   score = coverage * similarity * (1 - 0.3 * (1 - consistency))
// with coverage their share of the query's area, similarity their mean
// weighted by sqrt(area), and consistency how well the geodesic distances
// between them agree after the median change of scale, 0 .. 1.
#ifndef ARGMESH_CORE_MATCHING_PARTIAL_LEVEL_H_
#define ARGMESH_CORE_MATCHING_PARTIAL_LEVEL_H_

#include <vector>

#include "core/matching/match.h"
#include "core/matching/packed_graph.h"

namespace argmesh {

// At 0.37 of the mean distance of random nodes.
inline constexpr float kMinPartialSimilarity = 0.4F;

struct PartialLevelMatch {
  double score = 0;             // 0 .. 1, 1 for equal levels
  double query_coverage = 0;    // 0 .. 1
  std::vector<NodePair> pairs;  // the nodes found, sorted by query node
};

// Needs 1 <= nodes of the query <= nodes of the target.
PartialLevelMatch MatchPartialLevel(const PackedLevel& query,
                                    const PackedLevel& target);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_PARTIAL_LEVEL_H_
