#include "core/mesh/mesh_resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nanoflann.hpp>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_collapse.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_smooth.h"
#include "core/mesh/mesh_subdivide.h"
#include "core/mesh/mesh_weld.h"

namespace argmesh {
namespace {

constexpr int kMinBudget = 100;
constexpr int kMaxBudget = 100'000;
constexpr double kLongEdge = 1.5;  // of the mean edge length aimed at
constexpr int kMaxGrowth = 10;     // new vertices, of the budget
constexpr size_t kNearest = 8;
constexpr int kFacesPerCheck = 4096;

// The interface nanoflann asks for.
struct SampleCloud {
  const VertexMatrix& V;

  size_t kdtree_get_point_count() const {
    return static_cast<size_t>(V.rows());
  }
  double kdtree_get_pt(size_t v, size_t axis) const {
    return V(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(axis));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using SampleTree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, SampleCloud>, SampleCloud, 3,
    uint32_t>;

VertexMatrix SumFaceNormals(const TriangleMesh& mesh) {
  VertexMatrix normals = VertexMatrix::Zero(mesh.num_vertices(), 3);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::RowVector3d cross = FaceCross(mesh, f).transpose();
    for (int c = 0; c < 3; ++c) normals.row(mesh.F(f, c)) += cross;
  }
  return normals;
}

// The nearest sample whose normal is on the face's side; the nearest one when
// none of the first few is.
int32_t FindSample(const SampleTree& tree, const VertexMatrix& normals,
                   const Eigen::Vector3d& x, const Eigen::Vector3d& normal) {
  std::array<uint32_t, kNearest> found;
  std::array<double, kNearest> squared_distances;
  int32_t nearest = 0;
  for (const size_t k : {size_t{1}, kNearest}) {
    const size_t count =
        tree.knnSearch(x.data(), k, found.data(), squared_distances.data());
    for (size_t i = 0; i < count; ++i) {
      const auto v = static_cast<int32_t>(found[i]);
      if (normals.row(v).dot(normal) > 0) return v;
    }
    if (k == 1) nearest = static_cast<int32_t>(found[0]);
  }
  return nearest;
}

absl::StatusOr<std::vector<int32_t>> FindSamplesOfFaces(
    const TriangleMesh& mesh, const TriangleMesh& samples,
    const StopToken& stop) {
  const SampleCloud cloud{samples.V};
  const SampleTree tree(3, cloud);
  const VertexMatrix normals = SumFaceNormals(samples);
  std::vector<int32_t> sample_of_face(Slot(mesh.num_faces()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    if (f % kFacesPerCheck == 0) ARGMESH_RETURN_IF_ERROR(stop.Check());
    const Eigen::Vector3d centroid =
        (mesh.vertex(mesh.F(f, 0)) + mesh.vertex(mesh.F(f, 1)) +
         mesh.vertex(mesh.F(f, 2))) /
        3;
    sample_of_face[Slot(f)] =
        FindSample(tree, normals, centroid, FaceCross(mesh, f));
  }
  return sample_of_face;
}

absl::Status CheckInput(const TriangleMesh& mesh,
                        const ResampleOptions& options) {
  if (options.vertex_budget < kMinBudget ||
      options.vertex_budget > kMaxBudget) {
    return absl::InvalidArgumentError(
        absl::StrFormat("vertex_budget %d is not in %d .. %d",
                        options.vertex_budget, kMinBudget, kMaxBudget));
  }
  if (!(options.quadric_weight >= 0 && std::isfinite(options.quadric_weight))) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "quadric_weight %g is negative or not finite", options.quadric_weight));
  }
  ARGMESH_RETURN_IF_ERROR(CheckMesh(mesh));
  double area = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) area += FaceCross(mesh, f).norm();
  if (!(area > 0 && std::isfinite(area))) {
    return absl::FailedPreconditionError(absl::StrFormat(
        "%d faces have no positive, finite area together", mesh.num_faces()));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<ResampledMesh> ResampleMesh(const TriangleMesh& mesh,
                                           const ResampleOptions& options,
                                           const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(CheckInput(mesh, options));
  // At unit area and around the origin the quadrics keep most digits.
  TriangleMesh unit = mesh;
  RemoveUnusedVertices(unit);
  const UnitAreaTransform transform = NormalizeToUnitArea(unit);
  TriangleMesh dense = unit;
  // A mesh of n vertices has about 2 n triangles of area sqrt(3)/4 L^2.
  const double mean_edge =
      std::sqrt(4 / std::sqrt(3.0) / (2.0 * options.vertex_budget));
  ARGMESH_RETURN_IF_ERROR(SubdivideLongEdges(
      {.max_edge_length = kLongEdge * mean_edge,
       .min_vertices = options.vertex_budget,
       .max_new_vertices =
           std::max(kMaxGrowth * options.vertex_budget, unit.num_vertices())},
      stop, dense));
  ResampledMesh result;
  ARGMESH_ASSIGN_OR_RETURN(
      result.mesh, CollapseEdges(dense,
                                 {.target_vertices = options.vertex_budget,
                                  .quadric_weight = options.quadric_weight},
                                 stop));
  ARGMESH_ASSIGN_OR_RETURN(result.sample_of_face,
                           FindSamplesOfFaces(unit, result.mesh, stop));
  result.mesh.V /= transform.scale;
  result.mesh.V.rowwise() += transform.centroid.transpose();
  return result;
}

}  // namespace argmesh
