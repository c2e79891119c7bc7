// The assignment of rows to columns of the largest total profit.
//
// Shortest augmenting paths on dual prices, started with the rows that have
// their best column to themselves. Written here because no packaged library
// solves it for floating-point profits.
//
// Source   Jonker, Volgenant, "A Shortest Augmenting Path Algorithm for Dense
//          and Sparse Linear Assignment Problems", Computing 38, 1987;
//          Crouse, "On Implementing 2D Rectangular Assignment Algorithms",
//          IEEE Trans. AES 52(4), 2016.
// Input    rows x cols finite profits, row after row.
// Output   column of each row, all different; -1 for the rows left over when
//          there are more rows than columns.
// Repeats  equal input gives equal output; ties go to the lower index.
// Cost     O(min^2 max) at worst. Thread-safe.
#ifndef ARGMESH_CORE_MATCHING_ASSIGNMENT_H_
#define ARGMESH_CORE_MATCHING_ASSIGNMENT_H_

#include <cstdint>
#include <span>
#include <vector>

namespace argmesh {

std::vector<int32_t> SolveAssignment(std::span<const float> profits, int rows,
                                     int cols);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_ASSIGNMENT_H_
