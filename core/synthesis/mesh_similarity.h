// Seeded rearrangements that leave a shape the same: motions, scalings, other
// numbers for its vertices and faces; and damage that leaves it recognisable.
//
// Repeats  equal mesh and seed give bit-equal output.
// Cost     O(n + m). Thread-safe.
#ifndef ARGMESH_CORE_SYNTHESIS_MESH_SIMILARITY_H_
#define ARGMESH_CORE_SYNTHESIS_MESH_SIMILARITY_H_

#include <cstdint>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct SimilarityOptions {
  double max_log_scale = 2;     // scale is e^U(-x, x), x >= 0
  double max_translation = 10;  // per axis, in diagonals of the shape, >= 0
  bool renumber = true;         // shuffle vertices, faces, first corners
};

// A uniformly random rotation, then a scaling and a translation.
TriangleMesh RandomSimilarity(const TriangleMesh& mesh, uint64_t seed,
                              const SimilarityOptions& options = {});

// Leaves each face out with probability `share`, 0 .. 1, and the vertices
// that no face then uses.
TriangleMesh RemoveFaces(const TriangleMesh& mesh, double share, uint64_t seed);

// Every face gets three vertices of its own.
TriangleMesh MakeSoup(const TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_MESH_SIMILARITY_H_
