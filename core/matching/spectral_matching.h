// The correspondence of two levels by spectral matching: the pairs of nodes
// that agree best with each other on how far apart they lie.
//
// Candidates are the 4 most similar nodes of each node of the smaller level;
// two candidates support each other with exp(-|difference of distances| /
// 0.15) * sqrt of both similarities. Their principal eigenvector, made
// one-to-one greedily, is the correspondence.
//
// Source   Leordeanu, Hebert, "A Spectral Technique for Correspondence
//          Problems Using Pairwise Constraints", ICCV 2005.
// Repeats  equal input gives equal output; ties go to the lower index.
// Cost     O((4 n)^2 iterations) for n nodes in the smaller level. Thread-safe.
#ifndef ARGMESH_CORE_MATCHING_SPECTRAL_MATCHING_H_
#define ARGMESH_CORE_MATCHING_SPECTRAL_MATCHING_H_

#include <vector>

#include "core/matching/match.h"
#include "core/matching/packed_graph.h"

namespace argmesh {

// Pairs sorted by query node; each node in one pair at most. Equal levels are
// paired with themselves.
std::vector<NodePair> MatchSpectral(const PackedLevel& query,
                                    const PackedLevel& target, RowKind kind);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_SPECTRAL_MATCHING_H_
