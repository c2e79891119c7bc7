// The first step of a repair: one vertex where several lie together, and no
// faces that are degenerate or there twice. Orientation and connectivity stay
// as they come.
//
// Vertices are taken in order; each becomes the first earlier kept vertex
// within the distance, so chains of close vertices do not run together. Equal
// positions are always one vertex. Unused vertices are dropped first.
//
// Repeats  equal input gives bit-equal output.
// Cost     O((n + m) log m). Thread-safe.
#ifndef ARGMESH_CORE_MESH_MESH_WELD_H_
#define ARGMESH_CORE_MESH_MESH_WELD_H_

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct WeldedMesh {
  TriangleMesh mesh;  // no face where none has a positive, finite area
  std::vector<int32_t> source_face;
  double area = 0;  // of all triangles as given
  int64_t unused_vertices = 0;
  int64_t welded_vertices = 0;
  int64_t degenerate_faces = 0;  // repeated vertex or at most 1e-14 of the area
  int64_t duplicate_faces = 0;   // the same three vertices as an earlier face
};

// `weld_distance` in units of sqrt(surface area). CheckMesh(mesh) must hold.
WeldedMesh WeldMesh(const TriangleMesh& mesh, double weld_distance);

// Twice the area of face f as a vector along its normal.
inline Eigen::Vector3d FaceCross(const TriangleMesh& mesh, int f) {
  const Eigen::Vector3d a = mesh.vertex(mesh.F(f, 0));
  return (mesh.vertex(mesh.F(f, 1)) - a).cross(mesh.vertex(mesh.F(f, 2)) - a);
}

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_WELD_H_
