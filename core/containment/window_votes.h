// What the windows of a query say about each shape, and how much they say at
// all.
#ifndef ARGMESH_CORE_CONTAINMENT_WINDOW_VOTES_H_
#define ARGMESH_CORE_CONTAINMENT_WINDOW_VOTES_H_

#include <array>
#include <cstdint>
#include <vector>

#include "core/containment/window_set.h"

namespace argmesh {

// A query level a meets the target level a + 2 + k: the query is 2^(k/2) as
// long as the whole target, so that its share of the area is 2^k.
inline constexpr int kNumShifts = 8;
inline constexpr int kFirstShift = -7;

struct ShapeVotes {
  int64_t slot = 0;
  double score = 0;  // S, 0 .. 1: the largest of by_shift
  std::array<float, kNumShifts> by_shift = {};
};

struct VoteResult {
  std::vector<ShapeVotes> shapes;
  // For each window of the query, level by level: w_i idf_i, and their sum.
  std::vector<float> weights;
  double total_weight = 0;
  // sum w_i idf_i / sum w_i, 0 .. 1; 0 for a query without windows.
  double distinctiveness = 0;
};

// S against one shape from the windows themselves, under the weights of the
// index's votes and at its best three shifts for the shape, `indexed`.
// Cost about 1 ms. Thread-safe.
ShapeVotes VoteExactly(const QueryWindows& query, const VoteResult& votes,
                       const ShapeVotes& indexed, bool flipped,
                       const TargetWindows& target);

// Shift numbers by votes, descending; ties to the smaller shift.
std::array<int, kNumShifts> ShiftsByVotes(const ShapeVotes& votes);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_WINDOW_VOTES_H_
