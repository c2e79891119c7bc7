// An indexed triangle list: the truth about a surface's geometry.
//
// May be polygon soup, open, non-manifold or in several components; the
// functions that need more say so. Lengths are in any one unit.
#ifndef ARGMESH_CORE_MESH_TRIANGLE_MESH_H_
#define ARGMESH_CORE_MESH_TRIANGLE_MESH_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "absl/status/status.h"

namespace argmesh {

// n x 3 positions and m x 3 vertex indices, counter-clockwise from outside.
using VertexMatrix = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using FaceMatrix = Eigen::Matrix<int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

struct TriangleMesh {
  VertexMatrix V;
  FaceMatrix F;

  int num_vertices() const { return static_cast<int>(V.rows()); }
  int num_faces() const { return static_cast<int>(F.rows()); }
  Eigen::Vector3d vertex(int v) const { return V.row(v).transpose(); }
};

// kInvalidArgument when an index is outside 0..n-1 or a coordinate is not
// finite; names the face or vertex. Cost O(n + m).
absl::Status CheckMesh(const TriangleMesh& mesh);

// Compressed rows: items of row i are items[offsets[i] .. offsets[i+1]).
struct Adjacency {
  std::vector<int32_t> offsets;
  std::vector<int32_t> items;
};

// Faces around each vertex, in face order. Cost O(n + m).
Adjacency ComputeVertexFaces(const TriangleMesh& mesh);

// Drops the vertices that no face uses; keeps the order of the others.
// Returns the old index of each kept vertex.
std::vector<int32_t> RemoveUnusedVertices(TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_TRIANGLE_MESH_H_
