#include "client/picture/view.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace argmesh {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Area-weighted centroids of faces; vertices when no face has area.
struct Cloud {
  Eigen::Matrix<double, Eigen::Dynamic, 3> points;
  Eigen::VectorXd weights;
};

Cloud MakeCloud(const TriangleMesh& mesh) {
  Cloud cloud{.points = Eigen::MatrixX3d(mesh.num_faces(), 3),
              .weights = Eigen::VectorXd(mesh.num_faces())};
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Vector3d a = mesh.vertex(mesh.F(f, 0));
    const Vector3d b = mesh.vertex(mesh.F(f, 1));
    const Vector3d c = mesh.vertex(mesh.F(f, 2));
    cloud.points.row(f) = (a + b + c).transpose() / 3;
    cloud.weights[f] = 0.5 * (b - a).cross(c - a).norm();
  }
  if (cloud.weights.sum() <= 0) {
    cloud.points = mesh.V;
    cloud.weights = Eigen::VectorXd::Ones(mesh.V.rows());
  }
  cloud.weights /= cloud.weights.sum();
  cloud.points.rowwise() -= (cloud.weights.transpose() * cloud.points).eval();
  return cloud;
}

// Columns by ascending spread.
Matrix3d PrincipalAxes(const Cloud& cloud) {
  const Matrix3d covariance =
      cloud.points.transpose() * cloud.weights.asDiagonal() * cloud.points;
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(covariance).eigenvectors();
}

// The direction or its opposite: the one with the longer tail; for symmetric
// shapes the one with a positive largest coordinate.
Vector3d Signed(const Cloud& cloud, const Vector3d& axis) {
  const Eigen::ArrayXd along = (cloud.points * axis).array();
  const double scale =
      std::pow((along.square() * cloud.weights.array()).sum(), 1.5);
  const double third = (along.cube() * cloud.weights.array()).sum();
  if (std::abs(third) > 1e-3 * scale) return third > 0 ? axis : -axis;
  int largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] > 0 ? axis : -axis;
}

// Straight-on frame: columns right, up, toward the eye.
Matrix3d StandingFrame(const Cloud& cloud, const ViewOptions& options) {
  const Vector3d up = options.up->normalized();
  Vector3d toward = Vector3d::Zero();
  if (options.front) toward = *options.front - up * up.dot(*options.front);
  if (toward.norm() < 1e-9) {
    Cloud flat = cloud;
    flat.points -= (cloud.points * up) * up.transpose();
    const Vector3d longest = PrincipalAxes(flat).col(2);
    toward = Signed(flat, longest.cross(up).normalized());
  }
  toward.normalize();
  Matrix3d frame;
  frame << up.cross(toward), up, toward;
  return frame;
}

Matrix3d PrincipalFrame(const Cloud& cloud) {
  const Matrix3d axes = PrincipalAxes(cloud);
  const Vector3d right = Signed(cloud, axes.col(2));
  const Vector3d up = Signed(cloud, axes.col(1));
  Matrix3d frame;
  frame << right, up, right.cross(up);
  return frame;
}

// Centres the shape and chooses the largest scale that fits.
void Fit(const TriangleMesh& mesh, int width, int height, double margin,
         View& view) {
  Eigen::AlignedBox2d box;
  double depth_sum = 0;
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    const Vector3d p = mesh.vertex(v);
    box.extend(Eigen::Vector2d(p.dot(view.right), p.dot(view.up)));
    depth_sum += p.dot(view.toward);
  }
  const Eigen::Vector2d middle = box.center();
  view.center = view.right * middle.x() + view.up * middle.y() +
                view.toward * (depth_sum / mesh.num_vertices());
  const double border = 2 * margin * std::min(width, height);
  const Eigen::Vector2d size =
      box.sizes().cwiseMax(1e-12 * (1 + box.max().cwiseAbs().maxCoeff()));
  view.pixels_per_unit =
      std::min((width - border) / size.x(), (height - border) / size.y());
}

}  // namespace

View FitView(const TriangleMesh& mesh, int width, int height,
             const ViewOptions& options) {
  const Cloud cloud = MakeCloud(mesh);
  const Matrix3d frame = options.up && options.up->norm() > 0
                             ? StandingFrame(cloud, options)
                             : PrincipalFrame(cloud);
  const double to_radians = std::numbers::pi / 180;
  const Matrix3d turn =
      (Eigen::AngleAxisd(options.yaw_degrees * to_radians, Vector3d::UnitY()) *
       Eigen::AngleAxisd(-options.pitch_degrees * to_radians,
                         Vector3d::UnitX()))
          .toRotationMatrix();
  const Matrix3d turned = frame * turn;
  View view{.right = turned.col(0),
            .up = turned.col(1),
            .toward = turned.col(2),
            .ground_normal = frame.col(1),
            .center = Vector3d::Zero()};
  Fit(mesh, width, height, options.margin, view);
  return view;
}

}  // namespace argmesh
