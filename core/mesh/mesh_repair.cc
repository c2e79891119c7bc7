#include "core/mesh/mesh_repair.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_count.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_fans.h"
#include "core/mesh/mesh_orient.h"
#include "core/mesh/mesh_weld.h"

namespace argmesh {
namespace {

constexpr double kMaxWeldDistance = 0.01;

}  // namespace

absl::StatusOr<RepairedMesh> RepairMesh(const TriangleMesh& mesh,
                                        const RepairOptions& options) {
  if (!(options.weld_distance >= 0 &&
        options.weld_distance <= kMaxWeldDistance)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("weld_distance %g is not in 0 .. %g",
                        options.weld_distance, kMaxWeldDistance));
  }
  ARGMESH_RETURN_IF_ERROR(CheckMesh(mesh));
  WeldedMesh welded = WeldMesh(mesh, options.weld_distance);
  if (welded.mesh.num_faces() == 0) {
    return absl::FailedPreconditionError(absl::StrFormat(
        "none of %d faces has a positive area", mesh.num_faces()));
  }
  const MeshEdges edges =
      ComputeMeshEdges(welded.mesh.F, welded.mesh.num_vertices());
  RepairedMesh repaired;
  repaired.report = CountFound(mesh, welded, edges);
  repaired.mesh = std::move(welded.mesh);
  repaired.source_face = std::move(welded.source_face);
  OrientedFaces oriented = OrientFaces(repaired.mesh, edges);
  repaired.report.unorientable_components = oriented.unorientable_components;
  repaired.report.vertices_split = SplitFans(repaired.mesh, oriented.twins);
  OrientOutwards(repaired.mesh, oriented);
  repaired.report.faces_flipped =
      std::count(oriented.flipped.begin(), oriented.flipped.end(), 1);
  // Each joined side is half an edge, each other side a whole one.
  const int64_t joined =
      std::count_if(oriented.twins.begin(), oriented.twins.end(),
                    [](int32_t twin) { return twin >= 0; });
  const int64_t sides = static_cast<int64_t>(oriented.twins.size());
  repaired.report.euler_characteristic = int64_t{repaired.mesh.num_vertices()} -
                                         (sides - joined / 2) +
                                         repaired.mesh.num_faces();
  return repaired;
}

}  // namespace argmesh
