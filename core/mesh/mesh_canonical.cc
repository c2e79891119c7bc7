#include "core/mesh/mesh_canonical.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_weld.h"

namespace argmesh {
namespace {

constexpr double kGrid = 4194304;  // points per unit length
// Vertices are sorted along this direction. No small multiples of its parts
// add up to zero, so that neighbours of a regular mesh keep their order when
// the axes or the positions move by rounding.
constexpr double kSortDirection[] = {0.8191725134, 0.6710436067, 0.5497004779};
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

double Sign(double value) { return value < 0 ? -1 : 1; }

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

// Sets rotation and ambiguous. The two axes along which the surface is most
// lopsided point to the side of their third moment; the third one follows, so
// that a surface with one plane of symmetry has one frame.
void FindFrame(const TriangleMesh& unit, CanonicalMesh& canonical) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      ComputeCovariance(unit));
  const Eigen::Vector3d& variances = solver.eigenvalues();  // ascending
  const double gap =
      std::min(variances[2] - variances[1], variances[1] - variances[0]);
  canonical.ambiguous = !(gap > kSmallestGap * variances[2]);
  Eigen::Vector3d skew;
  for (int row = 0; row < 3; ++row) {
    const Eigen::Vector3d axis = solver.eigenvectors().col(2 - row);
    const ThirdMoment moment = ComputeThirdMoment(unit, axis);
    canonical.rotation.row(row) = axis.transpose() * Sign(moment.value);
    skew[row] =
        moment.magnitude > 0 ? std::abs(moment.value) / moment.magnitude : 0;
  }
  Eigen::Index least = 0;
  for (Eigen::Index row = 1; row < 3; ++row) {
    if (skew[row] < skew[least]) least = row;
  }
  canonical.rotation.row(least) *= Sign(canonical.rotation.determinant());
  skew[least] = 1;
  if (!(skew.minCoeff() > kSmallestSkew)) canonical.ambiguous = true;
}

using GridPoint = std::array<int64_t, 3>;
using Triple = std::array<int32_t, 3>;

std::vector<GridPoint> RoundPositions(const TriangleMesh& unit,
                                      const Eigen::Matrix3d& rotation) {
  std::vector<GridPoint> points;
  points.reserve(Slot(unit.num_vertices()));
  for (int v = 0; v < unit.num_vertices(); ++v) {
    const Eigen::Vector3d x = rotation * unit.vertex(v);
    points.push_back({std::llround(x[0] * kGrid), std::llround(x[1] * kGrid),
                      std::llround(x[2] * kGrid)});
  }
  return points;
}

std::vector<int32_t> SortedOrder(size_t count, const auto& is_before) {
  std::vector<int32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), is_before);
  return order;
}

// Places along the sort direction.
std::vector<double> SortKeys(const std::vector<GridPoint>& points) {
  std::vector<double> keys;
  keys.reserve(points.size());
  for (const GridPoint& point : points) {
    double key = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      key += kSortDirection[axis] * static_cast<double>(point[axis]);
    }
    keys.push_back(key);
  }
  return keys;
}

// The number of each point among the distinct ones in their order.
std::vector<int32_t> RankPoints(const std::vector<GridPoint>& points) {
  const std::vector<double> keys = SortKeys(points);
  const std::vector<int32_t> order =
      SortedOrder(points.size(), [&](int32_t a, int32_t b) {
        return keys[Slot(a)] != keys[Slot(b)]
                   ? keys[Slot(a)] < keys[Slot(b)]
                   : points[Slot(a)] < points[Slot(b)];
      });
  std::vector<int32_t> rank(points.size());
  int32_t next = -1;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || points[Slot(order[i])] != points[Slot(order[i - 1])]) ++next;
    rank[Slot(order[i])] = next;
  }
  return rank;
}

// A face's corner with the smallest number comes first.
Triple TurnedFace(const TriangleMesh& mesh, int f,
                  const std::vector<int32_t>& number) {
  Triple turned;
  for (int c = 0; c < 3; ++c) turned[Slot(c)] = number[Slot(mesh.F(f, c))];
  Triple smallest = turned;
  for (int turn = 0; turn < 2; ++turn) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    smallest = std::min(smallest, turned);
  }
  return smallest;
}

// Numbers of the vertices by position; those at one point by the first face,
// in the order of positions, that has them.
std::vector<int32_t> NumberVertices(const TriangleMesh& unit,
                                    const std::vector<GridPoint>& points) {
  const std::vector<int32_t> rank = RankPoints(points);
  std::vector<Triple> faces;
  faces.reserve(Slot(unit.num_faces()));
  for (int f = 0; f < unit.num_faces(); ++f) {
    faces.push_back(TurnedFace(unit, f, rank));
  }
  const std::vector<int32_t> face_order =
      SortedOrder(faces.size(), [&faces](int32_t a, int32_t b) {
        return std::pair(faces[Slot(a)], a) < std::pair(faces[Slot(b)], b);
      });
  std::vector<int32_t> first_face(points.size());
  for (size_t i = faces.size(); i-- > 0;) {
    for (int c = 0; c < 3; ++c) {
      first_face[Slot(unit.F(face_order[i], c))] = static_cast<int32_t>(i);
    }
  }
  const std::vector<int32_t> order =
      SortedOrder(points.size(), [&](int32_t a, int32_t b) {
        return Triple{rank[Slot(a)], first_face[Slot(a)], a} <
               Triple{rank[Slot(b)], first_face[Slot(b)], b};
      });
  std::vector<int32_t> number(points.size());
  for (size_t i = 0; i < order.size(); ++i) {
    number[Slot(order[i])] = static_cast<int32_t>(i);
  }
  return number;
}

// Sets mesh and source_face.
void Renumber(const TriangleMesh& unit, CanonicalMesh& canonical) {
  const std::vector<GridPoint> points =
      RoundPositions(unit, canonical.rotation);
  const std::vector<int32_t> number = NumberVertices(unit, points);
  canonical.mesh.V.resize(unit.num_vertices(), 3);
  for (int v = 0; v < unit.num_vertices(); ++v) {
    for (size_t axis = 0; axis < 3; ++axis) {
      canonical.mesh.V(number[Slot(v)], static_cast<Eigen::Index>(axis)) =
          static_cast<double>(points[Slot(v)][axis]) / kGrid;
    }
  }
  std::vector<Triple> faces;
  faces.reserve(Slot(unit.num_faces()));
  for (int f = 0; f < unit.num_faces(); ++f) {
    faces.push_back(TurnedFace(unit, f, number));
  }
  canonical.source_face =
      SortedOrder(faces.size(), [&faces](int32_t a, int32_t b) {
        return std::pair(faces[Slot(a)], a) < std::pair(faces[Slot(b)], b);
      });
  canonical.mesh.F.resize(unit.num_faces(), 3);
  for (size_t f = 0; f < faces.size(); ++f) {
    const Triple& corners = faces[Slot(canonical.source_face[f])];
    canonical.mesh.F.row(static_cast<Eigen::Index>(f)) << corners[0],
        corners[1], corners[2];
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
  Renumber(unit, canonical);
  return canonical;
}

}  // namespace argmesh
