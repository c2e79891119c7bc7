// How alike the nodes of two levels are, and what the levels score.
//
// One-to-one  the best assignment of nodes. Knows how many of a part there
//             are; but where one shape's part came apart and the other's did
//             not, all pieces but one stay without a partner.
// Nearest     each node with the most similar of the other level, however
//             often that is taken. Does not mind pieces, but does not count.
// A level's score is the mean of both.
#ifndef ARGMESH_CORE_MATCHING_LEVEL_SIMILARITY_H_
#define ARGMESH_CORE_MATCHING_LEVEL_SIMILARITY_H_

#include <vector>

#include "core/matching/packed_graph.h"

namespace argmesh {

// The distance at which the similarity of two nodes falls to 1/e.
inline constexpr float kSimilarityScale = 0.4F;

// An assigned pair's part of the score depends by this share on its edges: on
// exp(-|difference of geodesic distances| / kEdgeScale) to the other pairs.
inline constexpr double kEdgeShare = 0.2;
inline constexpr float kEdgeScale = 0.15F;  // sqrt(area of the shape)

// exp(-d / kSimilarityScale) of all pairs of nodes, a row for each node of
// `a`. Transposed to the bit when the levels are swapped.
std::vector<float> NodeSimilarities(const PackedLevel& a, const PackedLevel& b,
                                    RowKind kind);

// The mean of the two measures above, each weighted with the nodes' weights.
// 0 .. 1, 1 for equal levels; symmetric to the bit. Both levels have a node.
double ScoreLevels(const PackedLevel& a, const PackedLevel& b, RowKind kind);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_LEVEL_SIMILARITY_H_
