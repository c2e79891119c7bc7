// How much each window of a query counts before anything is known of a
// collection.
#ifndef ARGMESH_CORE_CONTAINMENT_QUERY_WEIGHTS_H_
#define ARGMESH_CORE_CONTAINMENT_QUERY_WEIGHTS_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "core/containment/window_set.h"
#include "core/containment/window_votes.h"

namespace argmesh {

// Level by level, in the order of the windows: (r / 0.06)^1.5 times accepted
// over described windows of the level.
std::vector<float> WindowWeights(const QueryWindows& query);

// The target level that query level `level` meets under shift number `shift`
// (0 .. kNumShifts - 1); none when there is no such level.
std::optional<size_t> MetLevel(size_t level, int shift);

// The length of the query in lengths of the target under a shift.
float ShiftScale(int shift);

const WindowDescriptor& DescriptorOf(const QueryWindow& window, bool flipped);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_QUERY_WEIGHTS_H_
