#include "core/signature/signature_surface.h"

#include <Eigen/Geometry>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/status_macros.h"
#include "core/geometry/area.h"
#include "core/mesh/mesh_canonical.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_smooth.h"
#include "core/mesh/mesh_weld.h"
#include "core/signature/implicit_smoothing.h"
#include "core/signature/outside_vote.h"

namespace argmesh {
namespace {

constexpr double kSmoothingTime = 3e-4;
constexpr double kSmallestFace = 1e-14;  // of the whole area

void DropFlatFaces(TriangleMesh& mesh) {
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  const double smallest = kSmallestFace * areas.sum();
  std::vector<int> kept;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    if (areas[f] > smallest) kept.push_back(f);
  }
  mesh.F = FaceMatrix(mesh.F(kept, Eigen::all));
}

// Of all edges, those of one face.
double BoundaryShare(const MeshEdges& edges) {
  size_t boundary = 0;
  for (size_t e = 0; e < edges.size(); ++e) {
    if (edges.sides_of(e).size() == 1) ++boundary;
  }
  return static_cast<double>(boundary) / static_cast<double>(edges.size());
}

void Measure(SignatureSurface& surface) {
  surface.face_areas = ComputeFaceAreas(surface.mesh);
  surface.face_normals.resize(surface.mesh.num_faces(), 3);
  for (int f = 0; f < surface.mesh.num_faces(); ++f) {
    surface.face_normals.row(f) =
        FaceCross(surface.mesh, f).normalized().transpose();
  }
}

}  // namespace

absl::StatusOr<SignatureSurface> PrepareSurface(const TriangleMesh& repaired,
                                                const SignatureOptions& options,
                                                const StopToken& stop) {
  ARGMESH_ASSIGN_OR_RETURN(CanonicalMesh canonical, CanonicalizeMesh(repaired));
  SignatureSurface surface;
  surface.mesh = std::move(canonical.mesh);
  DropFlatFaces(surface.mesh);
  const MeshEdges edges =
      ComputeMeshEdges(surface.mesh.F, surface.mesh.num_vertices());
  const double boundary_share = BoundaryShare(edges);
  if (boundary_share <= options.max_boundary_share) {
    ARGMESH_RETURN_IF_ERROR(
        SmoothImplicitly(edges, kSmoothingTime, stop, surface.mesh));
    surface.smoothed = true;
    DropFlatFaces(surface.mesh);
  }
  RemoveUnusedVertices(surface.mesh);
  NormalizeToUnitArea(surface.mesh);
  if (boundary_share > 0) {
    ARGMESH_RETURN_IF_ERROR(TurnOpenPiecesOut(stop, surface.mesh));
  }
  Measure(surface);
  return surface;
}

}  // namespace argmesh
