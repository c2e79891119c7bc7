// Links between samples of different components of a surface.
#ifndef ARGMESH_CORE_GEOMETRY_SURFACE_BRIDGES_H_
#define ARGMESH_CORE_GEOMETRY_SURFACE_BRIDGES_H_

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct Bridge {
  int32_t from;  // < to
  int32_t to;
  double length;
};

// Joins each sample to its nearest sample of each other component within
// `radius`, at most 4; then joins what is still apart by the shortest links
// between closest samples (a minimum spanning tree over the components, in
// rounds after Boruvka). Sorted by (from, to), each pair once.
//
// Repeats  equal input gives equal output; ties by index.
// Cost     O(n log n log c) for n samples in c components in practice.
std::vector<Bridge> ComputeBridges(const VertexMatrix& positions,
                                   std::span<const int32_t> component_of_vertex,
                                   int num_components, double radius);

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_SURFACE_BRIDGES_H_
