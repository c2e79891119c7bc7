#include "core/signature/chirality.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/area.h"

namespace argmesh {
namespace {

// Of the difference of two variances, as a share of their sum: axes closer
// than this count less.
constexpr double kClearGap = 0.05;

// Integrals over the surface as sums over the middles of edges, which are
// exact for squares.
template <typename Visit>
void VisitSurface(const TriangleMesh& mesh, const Eigen::VectorXd& areas,
                  Visit&& visit) {
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d a = mesh.vertex(mesh.F(f, 0));
    const Eigen::Vector3d b = mesh.vertex(mesh.F(f, 1));
    const Eigen::Vector3d c = mesh.vertex(mesh.F(f, 2));
    const double weight = areas[f] / 3;
    visit((a + b) / 2, weight);
    visit((b + c) / 2, weight);
    visit((c + a) / 2, weight);
  }
}

struct Frame {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes;        // rows, right-handed
  Eigen::Vector3d deviations;  // along the axes
  double clarity = 0;          // 0 where two axes could be exchanged
};

Frame FindFrame(const TriangleMesh& mesh, const Eigen::VectorXd& areas) {
  Frame frame;
  const double area = areas.sum();
  VisitSurface(mesh, areas, [&](const Eigen::Vector3d& x, double weight) {
    frame.centroid += weight / area * x;
  });
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  VisitSurface(mesh, areas, [&](const Eigen::Vector3d& x, double weight) {
    const Eigen::Vector3d d = x - frame.centroid;
    covariance += weight / area * d * d.transpose();
  });
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  frame.axes = solver.eigenvectors().transpose();
  if (frame.axes.determinant() < 0) frame.axes.row(0) *= -1;
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(0);
  frame.deviations = variances.cwiseSqrt();
  frame.clarity = 1;
  for (int k = 0; k < 2; ++k) {
    const double gap = (variances[k + 1] - variances[k]) /
                       std::max(variances[k + 1] + variances[k], 1e-30);
    frame.clarity *= gap / (gap + kClearGap);
  }
  return frame;
}

// Integrals odd in the axes that are named, along axes scaled to deviation 1;
// each is bounded by dividing by 1 + r^4.
struct OddMoments {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  // odd in one axis
  Eigen::Vector3d cubic = Eigen::Vector3d::Zero();
  Eigen::Vector3d yz = Eigen::Vector3d::Zero();  // odd in the two others
  double xyz = 0;
  double far_xyz = 0;
};

OddMoments Integrate(const TriangleMesh& mesh, const Eigen::VectorXd& areas,
                     const Frame& frame) {
  OddMoments moments;
  const double area = areas.sum();
  const Eigen::Vector3d scale =
      frame.deviations.cwiseMax(1e-6 * frame.deviations.maxCoeff() + 1e-300)
          .cwiseInverse();
  VisitSurface(mesh, areas, [&](const Eigen::Vector3d& point, double weight) {
    const Eigen::Vector3d q =
        scale.cwiseProduct(frame.axes * (point - frame.centroid));
    const double w = weight / area;
    const double squared = q.squaredNorm();
    const double bound = 1 / (1 + squared * squared / 9);
    moments.x += w * bound * squared * q;
    moments.cubic += w * bound * q.cwiseProduct(q.cwiseAbs2());
    moments.yz += w * bound * squared *
                  Eigen::Vector3d(q[1] * q[2], q[2] * q[0], q[0] * q[1]);
    moments.xyz += w * bound * q[0] * q[1] * q[2];
    moments.far_xyz += w * bound * squared * q[0] * q[1] * q[2];
  });
  return moments;
}

double SignedRoot(double value, double power) {
  return std::copysign(std::pow(std::abs(value), power), value);
}

}  // namespace

std::array<float, kChiralDims> MeasureChirality(const TriangleMesh& mesh) {
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  const Frame frame = FindFrame(mesh, areas);
  const OddMoments m = Integrate(mesh, areas, frame);
  const std::array<double, kChiralDims> values = {
      m.xyz,
      m.far_xyz / 3,
      SignedRoot(m.x[0] * m.yz[0], 0.5),
      SignedRoot(m.x[1] * m.yz[1], 0.5),
      SignedRoot(m.x[2] * m.yz[2], 0.5),
      SignedRoot(m.x.prod(), 1.0 / 3),
      SignedRoot(m.cubic.prod(), 1.0 / 3),
      SignedRoot(m.x[0] * m.x[1] * m.cubic[2], 1.0 / 3)};
  std::array<float, kChiralDims> chirality{};
  for (size_t i = 0; i < chirality.size(); ++i) {
    chirality[i] =
        static_cast<float>(std::clamp(frame.clarity * values[i], -1.0, 1.0));
  }
  return chirality;
}

}  // namespace argmesh
