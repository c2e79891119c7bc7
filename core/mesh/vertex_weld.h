// Which of a list of positions are equal, coordinate by coordinate. By
// sorting, so that no choice of positions makes it slow.
//
// Input    x, y, z of each position, all finite; 0 equals -0.
// Cost     O(n log n) time, 36 bytes a position. Thread-safe.
#ifndef ARGMESH_CORE_MESH_VERTEX_WELD_H_
#define ARGMESH_CORE_MESH_VERTEX_WELD_H_

#include <cstdint>
#include <span>
#include <vector>

namespace argmesh {

struct VertexWeld {
  // For each position the number of its distinct position, counted from 0 in
  // the order of first use.
  std::vector<int32_t> vertex_of;
  int32_t num_vertices = 0;
};

VertexWeld WeldEqualPositions(std::span<const double> coordinates);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_VERTEX_WELD_H_
