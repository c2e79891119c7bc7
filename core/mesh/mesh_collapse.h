// The second step of resampling: edges are collapsed, cheapest first, until a
// number of vertices is left.
//
// The cost of an edge is its squared length + quadric_weight * the mean
// squared distance of the merged vertex to the planes it stands for; planes
// through boundary edges hold the boundary in place.
// Costs within a 64th of an octave count as equal, far above the target those
// within an eighth.
//
// Source   Garland, Heckbert, "Surface Simplification Using Quadric Error
//          Metrics", SIGGRAPH 1997.
// Input    oriented 2-manifold with boundary, no unused vertices.
// Output   the same topology; each component keeps a face.
// Repeats  equal input gives bit-equal output; ties go by vertex number.
// Fails    kFailedPrecondition  not a manifold
//          kCancelled, kDeadlineExceeded
// Cost     O(m log m). Thread-safe.
#ifndef ARGMESH_CORE_MESH_MESH_COLLAPSE_H_
#define ARGMESH_CORE_MESH_MESH_COLLAPSE_H_

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct CollapseOptions {
  int target_vertices = 3000;  // > 0; more are left where nothing can go
  double quadric_weight = 20;  // >= 0
};

absl::StatusOr<TriangleMesh> CollapseEdges(const TriangleMesh& mesh,
                                           const CollapseOptions& options,
                                           const StopToken& stop);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_COLLAPSE_H_
