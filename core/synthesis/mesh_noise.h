// Noise along the normals of a surface.
//
// Input    any triangles; vertices without a normal stay where they are.
// Repeats  equal mesh and seed give bit-equal output.
// Cost     O(n + m). Thread-safe.
#ifndef ARGMESH_CORE_SYNTHESIS_MESH_NOISE_H_
#define ARGMESH_CORE_SYNTHESIS_MESH_NOISE_H_

#include <cstdint>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// Moves each vertex along its area-weighted normal by a normally distributed
// length with a standard deviation of `share` (>= 0) of the diagonal of the
// bounding box. Faces stay the same.
TriangleMesh AddNoise(const TriangleMesh& mesh, double share, uint64_t seed);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_MESH_NOISE_H_
