// The edges of a triangle list with the face sides that lie on each, for any
// list: soup, non-manifold and unoriented ones too.
//
// Side 3 f + c of face f runs from corner c to corner c + 1. Edges are sorted
// by their ends, the sides of an edge by number. A side from a vertex to
// itself is on no edge. Cost O(m) for bounded valence, O(m log m) otherwise.
#ifndef ARGMESH_CORE_MESH_MESH_EDGES_H_
#define ARGMESH_CORE_MESH_MESH_EDGES_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// A checked index as the size type of the standard containers.
constexpr size_t Slot(int32_t index) { return static_cast<size_t>(index); }

constexpr int32_t NextSide(int32_t side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}
constexpr int32_t PrevSide(int32_t side) {
  return side % 3 == 0 ? side + 2 : side - 1;
}

struct MeshEdges {
  std::vector<std::array<int32_t, 2>> ends;  // lower vertex first
  std::vector<int32_t> offsets;              // one more than edges
  std::vector<int32_t> sides;

  size_t size() const { return ends.size(); }
  std::span<const int32_t> sides_of(size_t edge) const {
    const size_t begin = Slot(offsets[edge]);
    return {sides.data() + begin, Slot(offsets[edge + 1]) - begin};
  }
};

MeshEdges ComputeMeshEdges(const FaceMatrix& F, int num_vertices);

// For each side the other side of its edge, or -1 where the edge has not
// exactly two.
std::vector<int32_t> ComputeTwins(const MeshEdges& edges, int num_faces);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_EDGES_H_
