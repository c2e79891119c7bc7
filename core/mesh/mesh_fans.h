// The third step of a repair: one fan of faces around each vertex.
#ifndef ARGMESH_CORE_MESH_MESH_FANS_H_
#define ARGMESH_CORE_MESH_MESH_FANS_H_

#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// Gives every fan of faces around a vertex but the first a copy of the vertex,
// appended to mesh.V; returns the number of copies.
//
// A fan is walked across `twins`, which join sides of opposite direction. Two
// boundary sides that have the same two ends afterwards are a slit closed by
// the split; they are joined in `twins`.
//
// Output   an oriented 2-manifold with boundary.
// Repeats  equal input gives bit-equal output.
// Cost     O(m + boundary log boundary). Thread-safe.
int64_t SplitFans(TriangleMesh& mesh, std::vector<int32_t>& twins);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_FANS_H_
