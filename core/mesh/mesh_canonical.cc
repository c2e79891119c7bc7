#include "core/mesh/mesh_canonical.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_weld.h"

namespace argmesh {
namespace {

constexpr double kGrid = 65536;  // points per unit length
// Below these, rounding of the input decides the frame. An axis turns by
// rounding / gap; it must not move a vertex by a good part of a grid cell.
constexpr double kSmallestGap = 1e-9;   // between variances, of the largest
constexpr double kSmallestSkew = 1e-9;  // of the third absolute moment

double TotalArea(const TriangleMesh& mesh) {
  double area = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    area += FaceCross(mesh, f).norm() / 2;
  }
  return area;
}

// Integral of x x^T over the surface of a mesh of unit area at the origin.
Eigen::Matrix3d ComputeCovariance(const TriangleMesh& mesh) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d a = mesh.vertex(mesh.F(f, 0));
    const Eigen::Vector3d b = mesh.vertex(mesh.F(f, 1));
    const Eigen::Vector3d c = mesh.vertex(mesh.F(f, 2));
    const Eigen::Vector3d sum = a + b + c;
    covariance += FaceCross(mesh, f).norm() / 24 *
                  (sum * sum.transpose() + a * a.transpose() +
                   b * b.transpose() + c * c.transpose());
  }
  return covariance;
}

struct ThirdMoment {
  double value = 0;
  double magnitude = 0;  // of the absolute values
};

// Sums the cubes at the corners, weighted by area: a moment of the vertices
// that moves with the surface, which is all that a sign needs.
ThirdMoment ComputeThirdMoment(const TriangleMesh& mesh,
                               const Eigen::Vector3d& axis) {
  ThirdMoment moment;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const double weight = FaceCross(mesh, f).norm() / 6;
    for (int c = 0; c < 3; ++c) {
      const double x = mesh.vertex(mesh.F(f, c)).dot(axis);
      moment.value += weight * x * x * x;
      moment.magnitude += weight * std::abs(x * x * x);
    }
  }
  return moment;
}

// Sets rotation and ambiguous.
void FindFrame(const TriangleMesh& unit, CanonicalMesh& canonical) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      ComputeCovariance(unit));
  const Eigen::Vector3d variances = solver.eigenvalues();  // ascending
  const double gap =
      std::min(variances[2] - variances[1], variances[1] - variances[0]);
  canonical.ambiguous = !(gap > kSmallestGap * variances[2]);
  for (int row = 0; row < 2; ++row) {
    Eigen::Vector3d axis = solver.eigenvectors().col(2 - row);
    const ThirdMoment moment = ComputeThirdMoment(unit, axis);
    if (moment.value < 0) axis = -axis;
    if (!(std::abs(moment.value) > kSmallestSkew * moment.magnitude)) {
      canonical.ambiguous = true;
    }
    canonical.rotation.row(row) = axis.transpose();
  }
  const Eigen::Vector3d x = canonical.rotation.row(0).transpose();
  const Eigen::Vector3d y = canonical.rotation.row(1).transpose();
  canonical.rotation.row(2) = x.cross(y).transpose();
}

// Rounds the positions, sorts them without repetition into mesh.V and returns
// the new number of each vertex.
std::vector<int32_t> SortPositions(const TriangleMesh& unit,
                                   const Eigen::Matrix3d& rotation,
                                   TriangleMesh& mesh) {
  using GridPoint = std::array<int64_t, 3>;
  const size_t count = Slot(unit.num_vertices());
  std::vector<GridPoint> points(count);
  for (int v = 0; v < unit.num_vertices(); ++v) {
    const Eigen::Vector3d x = rotation * unit.vertex(v);
    points[Slot(v)] = {std::llround(x[0] * kGrid), std::llround(x[1] * kGrid),
                       std::llround(x[2] * kGrid)};
  }
  std::vector<int32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&points](int32_t a, int32_t b) {
    return points[Slot(a)] < points[Slot(b)];
  });
  std::vector<int32_t> number(count);
  mesh.V.resize(unit.num_vertices(), 3);
  Eigen::Index rows = 0;
  for (size_t i = 0; i < count; ++i) {
    const GridPoint& point = points[Slot(order[i])];
    if (i == 0 || point != points[Slot(order[i - 1])]) {
      for (size_t axis = 0; axis < 3; ++axis) {
        mesh.V(rows, static_cast<Eigen::Index>(axis)) =
            static_cast<double>(point[axis]) / kGrid;
      }
      ++rows;
    }
    number[Slot(order[i])] = static_cast<int32_t>(rows - 1);
  }
  mesh.V.conservativeResize(rows, 3);
  return number;
}

void SortFaces(const TriangleMesh& unit, const std::vector<int32_t>& number,
               CanonicalMesh& canonical) {
  struct NumberedFace {
    std::array<int32_t, 3> corners;
    int32_t source;
  };
  std::vector<NumberedFace> faces(Slot(unit.num_faces()));
  for (int f = 0; f < unit.num_faces(); ++f) {
    std::array<int32_t, 3>& corners = faces[Slot(f)].corners;
    for (int c = 0; c < 3; ++c) {
      corners[Slot(c)] = number[Slot(unit.F(f, c))];
    }
    // The smallest rotation, also where a vertex repeats.
    std::array<int32_t, 3> turned = corners;
    for (int turn = 0; turn < 2; ++turn) {
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
      corners = std::min(corners, turned);
    }
    faces[Slot(f)].source = f;
  }
  std::sort(faces.begin(), faces.end(),
            [](const NumberedFace& a, const NumberedFace& b) {
              return a.corners != b.corners ? a.corners < b.corners
                                            : a.source < b.source;
            });
  canonical.mesh.F.resize(unit.num_faces(), 3);
  for (size_t f = 0; f < faces.size(); ++f) {
    for (size_t c = 0; c < 3; ++c) {
      canonical.mesh.F(static_cast<Eigen::Index>(f),
                       static_cast<Eigen::Index>(c)) = faces[f].corners[c];
    }
    canonical.source_face.push_back(faces[f].source);
  }
}

}  // namespace

absl::StatusOr<CanonicalMesh> CanonicalizeMesh(const TriangleMesh& mesh) {
  ARGMESH_RETURN_IF_ERROR(CheckMesh(mesh));
  const double area = TotalArea(mesh);
  if (!(area > 0 && std::isfinite(area))) {
    return absl::FailedPreconditionError(absl::StrFormat(
        "%d faces have no positive, finite area together", mesh.num_faces()));
  }
  TriangleMesh unit = mesh;
  RemoveUnusedVertices(unit);
  CanonicalMesh canonical;
  canonical.unit_area = NormalizeToUnitArea(unit);
  FindFrame(unit, canonical);
  const std::vector<int32_t> number =
      SortPositions(unit, canonical.rotation, canonical.mesh);
  SortFaces(unit, number, canonical);
  return canonical;
}

}  // namespace argmesh
