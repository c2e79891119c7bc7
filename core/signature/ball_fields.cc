#include "core/signature/ball_fields.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace argmesh {
namespace {

constexpr float kNearRadius = 0.05F;
constexpr float kWideRadius = 0.10F;
constexpr float kAgreement = 0.2F;  // least cosine between normals
constexpr int kMinFitted = 8;
constexpr double kRidge = 1e-3;
constexpr double kFlatness = 0.02;  // added to the curvedness under the log
constexpr double kMinSpread = 1e-9;

struct Neighbor {
  Eigen::Vector3f offset;  // from the centre
  Eigen::Vector3f normal;
  float squared;
};

struct Curvatures {
  double max = 0, min = 0;
};

// Of the graph z = a x^2/2 + b xy + c y^2/2 + d x + e y + f at its centre.
Curvatures QuadricCurvatures(const Eigen::Matrix<double, 6, 1>& q) {
  const double slope = 1 + q[3] * q[3] + q[4] * q[4];
  Eigen::Matrix2d first;
  first << 1 + q[3] * q[3], q[3] * q[4], q[3] * q[4], 1 + q[4] * q[4];
  Eigen::Matrix2d second;
  second << q[0], q[1], q[1], q[2];
  second /= -std::sqrt(slope);
  const Eigen::Matrix2d shape = first.inverse() * second;
  const double mean = shape.trace() / 2;
  const double spread =
      std::sqrt(std::max(0.0, mean * mean - shape.determinant()));
  return {mean + spread, mean - spread};
}

// Principal curvatures in units of 1/radius.
Curvatures FitCurvatures(std::span<const Neighbor> ball,
                         const Eigen::Vector3f& normal, float radius) {
  Eigen::Vector3f axis = Eigen::Vector3f::Zero();
  for (const Neighbor& n : ball) {
    if (n.normal.dot(normal) > kAgreement) axis += n.normal;
  }
  if (axis.norm() < 1e-6F) axis = normal;
  axis.normalize();
  const Eigen::Vector3f u = axis.unitOrthogonal();
  const Eigen::Vector3f v = axis.cross(u);
  Eigen::Matrix<float, 6, 6> squares = Eigen::Matrix<float, 6, 6>::Zero();
  Eigen::Matrix<float, 6, 1> heights = Eigen::Matrix<float, 6, 1>::Zero();
  int fitted = 0;
  for (const Neighbor& n : ball) {
    if (n.normal.dot(axis) < kAgreement) continue;
    ++fitted;
    const float x = n.offset.dot(u) / radius;
    const float y = n.offset.dot(v) / radius;
    Eigen::Matrix<float, 6, 1> row;
    row << x * x / 2, x * y, y * y / 2, x, y, 1;
    squares.noalias() += row * row.transpose();
    heights += row * (n.offset.dot(axis) / radius);
  }
  if (fitted < kMinFitted) return {};
  Eigen::Matrix<double, 6, 6> system = squares.cast<double>();
  for (int k = 0; k < 3; ++k) system(k, k) += kRidge * fitted;
  for (int k = 0; k < 6; ++k) system(k, k) += 1e-9;
  return QuadricCurvatures(system.ldlt().solve(heights.cast<double>()));
}

BallFields MeasureBall(std::span<const Neighbor> ball,
                       const Eigen::Vector3f& normal, float radius,
                       size_t points) {
  BallFields fields;
  const Curvatures k = FitCurvatures(ball, normal, radius);
  fields.shape_index = static_cast<float>(
      2 / std::numbers::pi *
      std::atan2(k.max + k.min, std::max(k.max - k.min, kMinSpread)));
  fields.curvedness = static_cast<float>(
      std::log(std::sqrt((k.max * k.max + k.min * k.min) / 2) + kFlatness));
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Neighbor& n : ball) sum += n.offset;
  const auto count = static_cast<float>(ball.size());
  fields.offset = sum.dot(normal) / (count * radius);
  fields.area = count / (std::numbers::pi_v<float> * radius * radius *
                         static_cast<float>(points));
  return fields;
}

}  // namespace

BallMeter::BallMeter(std::span<const Eigen::Vector3f> positions,
                     std::span<const Eigen::Vector3f> normals)
    : positions_(positions), normals_(normals), tree_(positions) {}

TwoBalls BallMeter::Measure(int32_t index) const {
  const Eigen::Vector3f center = positions_[static_cast<size_t>(index)];
  const Eigen::Vector3f normal = normals_[static_cast<size_t>(index)];
  std::vector<Neighbor> ball;
  tree_.VisitBall(center, kWideRadius, [&](int32_t place, float squared) {
    const auto at = static_cast<size_t>(place);
    ball.push_back({tree_.points()[at] - center,
                    normals_[static_cast<size_t>(tree_.numbers()[at])],
                    squared});
  });
  TwoBalls balls;
  balls.wide = MeasureBall(ball, normal, kWideRadius, positions_.size());
  std::erase_if(ball, [](const Neighbor& n) {
    return n.squared > kNearRadius * kNearRadius;
  });
  balls.near = MeasureBall(ball, normal, kNearRadius, positions_.size());
  return balls;
}

}  // namespace argmesh
