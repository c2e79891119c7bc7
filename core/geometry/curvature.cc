#include "core/geometry/curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "core/geometry/geodesic.h"

namespace argmesh {
namespace {

// What one triangle or a set of them measures.
struct Measures {
  double area = 0;
  double mu0 = 0;  // corrected area
  double mu1 = 0;  // twice the integral of the mean curvature
  double mu2 = 0;  // integral of the Gaussian curvature

  void Add(const Measures& other) {
    area += other.area;
    mu0 += other.mu0;
    mu1 += other.mu1;
    mu2 += other.mu2;
  }
};

// Below this share of its area a corrected area says that the normals do not
// belong to the faces; it is not divided by.
constexpr double kMinCorrectedShare = 0.05;

Measures MeasureFace(const TriangleMesh& mesh, const VertexMatrix& normals,
                     int f) {
  const int i = mesh.F(f, 0);
  const int j = mesh.F(f, 1);
  const int k = mesh.F(f, 2);
  const Eigen::Vector3d ui = normals.row(i).transpose();
  const Eigen::Vector3d uj = normals.row(j).transpose();
  const Eigen::Vector3d uk = normals.row(k).transpose();
  const Eigen::Vector3d mean = (ui + uj + uk) / 3;
  // mu1 does not change under translation; taking x_i as the origin keeps its
  // terms as small as the triangle.
  const Eigen::Vector3d xj = mesh.vertex(j) - mesh.vertex(i);
  const Eigen::Vector3d xk = mesh.vertex(k) - mesh.vertex(i);
  const Eigen::Vector3d twice_area = xj.cross(xk);
  return {twice_area.norm() / 2, mean.dot(twice_area) / 2,
          mean.dot((ui - uk).cross(xj) + (uj - ui).cross(xk)) / 2,
          ui.dot(uj.cross(uk)) / 2};
}

// Each vertex carries a third of its faces, so that the sum over a set of
// vertices counts a face by the share of its corners in the set.
std::vector<Measures> MeasureVertices(const TriangleMesh& mesh,
                                      const VertexMatrix& normals) {
  std::vector<Measures> measures(static_cast<size_t>(mesh.num_vertices()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    Measures third = MeasureFace(mesh, normals, f);
    third.area /= 3;
    third.mu0 /= 3;
    third.mu1 /= 3;
    third.mu2 /= 3;
    for (int k = 0; k < 3; ++k) measures.data()[mesh.F(f, k)].Add(third);
  }
  return measures;
}

}  // namespace

Curvatures ComputeCurvatures(const TriangleMesh& mesh,
                             const VertexMatrix& normals,
                             const SurfaceGraph& graph, double radius) {
  const int n = mesh.num_vertices();
  const std::vector<Measures> measures = MeasureVertices(mesh, normals);
  Curvatures curvatures{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  GeodesicSolver solver(graph);
  for (int v = 0; v < n; ++v) {
    Measures ball;
    for (const auto& reached :
         solver.FindWithin(v, static_cast<float>(radius))) {
      ball.Add(measures.data()[reached.vertex]);
    }
    if (!(ball.area > 0)) continue;
    const double mu0 = std::max(ball.mu0, kMinCorrectedShare * ball.area);
    curvatures.mean[v] = ball.mu1 / (2 * mu0);
    curvatures.gaussian[v] = ball.mu2 / mu0;
  }
  return curvatures;
}

VertexMatrix ComputeSmoothedNormals(const TriangleMesh& mesh,
                                    const VertexMatrix& normals,
                                    const Eigen::VectorXd& areas,
                                    const SurfaceGraph& graph, double radius) {
  VertexMatrix smoothed = normals;
  GeodesicSolver solver(graph);
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    double area = 0;
    for (const auto& reached :
         solver.FindWithin(v, static_cast<float>(radius))) {
      sum += areas[reached.vertex] * normals.row(reached.vertex);
      area += areas[reached.vertex];
    }
    // Normals that cancel each other leave no direction: keep the own one.
    const double length = sum.norm();
    if (length > 1e-6 * area) smoothed.row(v) = sum / length;
  }
  return smoothed;
}

}  // namespace argmesh
