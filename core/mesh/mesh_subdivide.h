// The first step of resampling: no edge is left longer than a bound.
#ifndef ARGMESH_CORE_MESH_MESH_SUBDIVIDE_H_
#define ARGMESH_CORE_MESH_MESH_SUBDIVIDE_H_

#include "absl/status/status.h"
#include "core/base/stop_token.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct SubdivideOptions {
  double max_edge_length = 0;  // > 0, in the mesh's unit
  int min_vertices = 0;        // the bound is tightened until there are so many
  int max_new_vertices = 0;    // the longest edges first where it binds
};

// Splits edges at their midpoints, all too long ones of a pass at once; a face
// is cut by which of its edges are split. Keeps the surface, its orientation
// and its topology; copies of a vertex stay apart.
//
// Fails    kCancelled, kDeadlineExceeded
// Cost     O(m) each pass; about log2(longest edge / bound) passes.
absl::Status SubdivideLongEdges(const SubdivideOptions& options,
                                const StopToken& stop, TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_SUBDIVIDE_H_
