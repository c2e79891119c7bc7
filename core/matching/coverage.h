// The share of a level's area that a correspondence covers.
#ifndef ARGMESH_CORE_MATCHING_COVERAGE_H_
#define ARGMESH_CORE_MATCHING_COVERAGE_H_

#include <span>

#include "core/matching/match.h"
#include "core/matching/packed_graph.h"

namespace argmesh {

// Of the nodes in `pairs`; exactly 1 when all of them are. 0 .. 1
double QueryCoverage(const PackedLevel& query, std::span<const NodePair> pairs);
double TargetCoverage(const PackedLevel& target,
                      std::span<const NodePair> pairs);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_COVERAGE_H_
