// Turns any triangle list into an oriented 2-manifold with boundary.
//
// Welds vertices closer than `weld_distance`, drops degenerate and duplicate
// faces, orients each edge-connected component consistently (closed components
// outwards by signed volume; open ones by the orientation of most of their
// area), splits vertices where the surface is not manifold. Polygon soup,
// several components and open surfaces are ordinary input.
//
// Repeats  equal input gives bit-equal output.
// Fails    kFailedPrecondition  no face of positive area
// Cost     O((n + m) log n). Thread-safe.
#ifndef ARGMESH_CORE_MESH_MESH_REPAIR_H_
#define ARGMESH_CORE_MESH_MESH_REPAIR_H_

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct RepairOptions {
  // In units of sqrt(surface area); 0 welds equal positions only. 0 .. 0.01.
  double weld_distance = 1e-5;
};

struct RepairedMesh {
  TriangleMesh mesh;
  // For each face of `mesh` the face of the input it is.
  std::vector<int32_t> source_face;
  MeshReport report;
};

absl::StatusOr<RepairedMesh> RepairMesh(const TriangleMesh& mesh,
                                        const RepairOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_REPAIR_H_
