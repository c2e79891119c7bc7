// What was found in a mesh and what was done to it. Nothing is dropped or
// changed without a count here.
#ifndef ARGMESH_CORE_MESH_MESH_REPORT_H_
#define ARGMESH_CORE_MESH_MESH_REPORT_H_

#include <cstdint>

namespace argmesh {

struct MeshReport {
  // Found in the triangles as given.
  int64_t vertices = 0;
  int64_t faces = 0;
  int64_t components = 0;         // connected by shared vertices after welding
  int64_t boundary_edges = 0;     // edges of one face
  int64_t nonmanifold_edges = 0;  // edges of more than two faces
  int64_t nonmanifold_vertices = 0;     // face fans around them are not one fan
  int64_t unorientable_components = 0;  // cut along a seam; connected by edges
  int64_t unused_vertices = 0;
  double area = 0;  // in the square of the file's unit
  // Of the vertices that faces use.
  double bounding_box_min[3] = {0, 0, 0};
  double bounding_box_max[3] = {0, 0, 0};
  // Euler characteristic V - E + F of the repaired surface; 2 - 2 genus for
  // one closed component.
  int64_t euler_characteristic = 0;

  // Repaired or dropped.
  int64_t welded_vertices = 0;
  int64_t degenerate_faces_dropped = 0;  // repeated vertex or zero area
  int64_t duplicate_faces_dropped = 0;   // the same three vertices again
  int64_t faces_flipped = 0;             // to orient a component consistently
  int64_t vertices_split = 0;  // copies made where it was not manifold

  // Set by the abstraction.
  int64_t sample_vertices = 0;
  bool smoothed = false;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_REPORT_H_
