// Sets of numbers 0 .. n-1 that only grow together. Elements of one set lead
// to one root over `parent`; a root is its own parent.
//
//   std::vector<int32_t> parent(n);
//   std::iota(parent.begin(), parent.end(), 0);
//   parent[FindRoot(parent, a)] = FindRoot(parent, b);  // joins two sets
//
// Cost     O(log n) amortised: paths are halved on the way.
#ifndef ARGMESH_CORE_BASE_DISJOINT_SETS_H_
#define ARGMESH_CORE_BASE_DISJOINT_SETS_H_

#include <cstddef>
#include <cstdint>
#include <vector>

namespace argmesh {

inline int32_t FindRoot(std::vector<int32_t>& parent, int32_t element) {
  const auto up = [&parent](int32_t x) -> int32_t& {
    return parent[static_cast<size_t>(x)];
  };
  while (up(element) != element) {
    up(element) = up(up(element));
    element = up(element);
  }
  return element;
}

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_DISJOINT_SETS_H_
