// Resamples a surface to about `vertex_budget` evenly spread vertices, so that
// what is computed on it does not depend on how it was tessellated.
//
// Edges longer than 1.5 L are split, L = sqrt(4/sqrt(3) A / (2 budget)), then
// edges are collapsed cheapest first (squared length + 20 * quadric error)
// under the link condition and without flipping normals, until the budget is
// met or nothing can be collapsed.
//
// Source   Garland, Heckbert, "Surface Simplification Using Quadric Error
//          Metrics", SIGGRAPH 1997.
// Input    oriented 2-manifold with boundary (RepairMesh's output).
// Repeats  equal input gives bit-equal output.
// Fails    kInvalidArgument     budget outside its range
//          kFailedPrecondition  no face of positive area
//          kCancelled, kDeadlineExceeded
// Cost     O((m + budget) log (m + budget)). Thread-safe.
#ifndef ARGMESH_CORE_MESH_MESH_RESAMPLE_H_
#define ARGMESH_CORE_MESH_MESH_RESAMPLE_H_

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct ResampleOptions {
  int vertex_budget = 3000;    // 100 .. 100,000
  double quadric_weight = 20;  // >= 0; larger keeps sharp features better
};

struct ResampledMesh {
  TriangleMesh mesh;  // manifold, no unused vertices
  // For each face of the input the vertex of `mesh` nearest to its centroid
  // among those whose normal agrees.
  std::vector<int32_t> sample_of_face;
};

absl::StatusOr<ResampledMesh> ResampleMesh(const TriangleMesh& mesh,
                                           const ResampleOptions& options = {},
                                           const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_RESAMPLE_H_
