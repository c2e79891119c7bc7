// The second step of a repair: faces that share an edge wind the same way.
//
// Input    every face has three vertices; edges may have any number of faces.
// Repeats  equal input gives bit-equal output.
// Cost     O(m). Thread-safe.
#ifndef ARGMESH_CORE_MESH_MESH_ORIENT_H_
#define ARGMESH_CORE_MESH_MESH_ORIENT_H_

#include <cstdint>
#include <vector>

#include "core/mesh/mesh_edges.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct OrientedFaces {
  // By face; connected across edges of exactly two faces.
  std::vector<int32_t> component;
  int32_t num_components = 0;
  std::vector<char> flipped;  // by face
  // By side: the opposite side it joins, or -1 at a boundary, at an edge of
  // more than two faces and along the seam of an unorientable component.
  std::vector<int32_t> twins;
  int64_t unorientable_components = 0;
};

// Flips rows of mesh.F so that each component is consistent and most of its
// area stays as given.
OrientedFaces OrientFaces(TriangleMesh& mesh, const MeshEdges& edges);

// Flips the components without any boundary whose signed volume is negative.
// `oriented` goes with `mesh`.
void OrientOutwards(TriangleMesh& mesh, OrientedFaces& oriented);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_ORIENT_H_
