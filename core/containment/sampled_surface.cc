#include "core/containment/sampled_surface.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace argmesh {
namespace {

constexpr float kReach = 3;             // in sd of the Gaussian
constexpr float kMinCosine = 0.3F;      // of normals that are aligned
constexpr float kPointToPoint = 0.03F;  // weight beside point to plane
constexpr int kMinAligned = 10;
constexpr float kMaxScaleRatio = 1.6F;
constexpr float kMaxLogScaleStep = 0.2F;
constexpr float kMaxAngle = 2;

using Vector7f = Eigen::Matrix<float, 7, 1>;
using Matrix7f = Eigen::Matrix<float, 7, 7>;

// Rotation, shift in units of the laid surface, log scale.
Vector7f Jacobian(const Eigen::Vector3f& arm, const Eigen::Vector3f& direction,
                  float scale) {
  Vector7f row;
  row.head<3>() = arm.cross(direction);
  row.segment<3>(3) = scale * direction;
  row[6] = arm.dot(direction);
  return row;
}

struct NormalEquations {
  Matrix7f matrix = Matrix7f::Zero();
  Vector7f right = Vector7f::Zero();

  void Add(const Vector7f& row, float residual, float weight) {
    matrix.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    right += weight * residual * row;
  }
};

float Update(const Vector7f& step, const Eigen::Vector3f& middle,
             const Eigen::Vector3f& moved_middle, float expected_scale,
             Similarity& place) {
  const float angle = step.head<3>().norm();
  if (!(angle < kMaxAngle) || !step.allFinite()) return 0;
  if (angle > 1e-9F) {
    place.rotation =
        Eigen::AngleAxisf(angle, step.head<3>() / angle).toRotationMatrix() *
        place.rotation;
  }
  const Eigen::Vector3f center =
      moved_middle + place.scale * step.segment<3>(3);
  const float scale =
      place.scale *
      std::exp(std::clamp(step[6], -kMaxLogScaleStep, kMaxLogScaleStep));
  if (scale <= expected_scale * kMaxScaleRatio &&
      scale >= expected_scale / kMaxScaleRatio) {
    place.scale = scale;
  }
  place.shift = center - place.scale * (place.rotation * middle);
  return angle + step.segment<3>(3).norm() + std::abs(step[6]);
}

}  // namespace

LaidSurface MakeLaidSurface(const QueryWindows& query, bool flipped) {
  LaidSurface laid{query.points, query.normals};
  if (flipped) {
    for (Eigen::Vector3f& normal : laid.normals) normal = -normal;
  }
  return laid;
}

SampledSurface::SampledSurface(
    std::span<const Eigen::Vector3f> points,
    std::span<const Eigen::Vector3f> unordered_normals, float sample_spacing)
    : tree(points), spacing(sample_spacing) {
  normals.reserve(points.size());
  for (const int32_t number : tree.numbers()) {
    normals.push_back(unordered_normals[static_cast<size_t>(number)]);
  }
}

SampledSurface MakeSampledSurface(std::span<const PackedPoint> points) {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  positions.reserve(points.size());
  normals.reserve(points.size());
  for (const PackedPoint& point : points) {
    positions.push_back(UnpackPosition(point));
    normals.push_back(UnpackNormal(point));
  }
  const auto count = static_cast<float>(std::max<size_t>(1, points.size()));
  return {positions, normals, 1 / std::sqrt(count)};
}

float Cover(const Similarity& place, const LaidSurface& laid, size_t begin,
            size_t end, const SampledSurface& target, float tau) {
  end = std::min(end, laid.points.size());
  if (begin >= end) return 0;
  const float sd = tau * place.scale;
  const float reach = kReach * sd + target.spacing;
  const float falloff = -1 / (2 * sd * sd);
  float sum = 0;
  for (size_t i = begin; i < end; ++i) {
    const Eigen::Vector3f p = place.Apply(laid.points[i]);
    const PointTree::Nearest nearest =
        target.tree.FindNearest(p, reach * reach);
    if (nearest.place < 0) continue;
    const auto at = static_cast<size_t>(nearest.place);
    const Eigen::Vector3f& normal = target.normals[at];
    const float cosine = (place.rotation * laid.normals[i]).dot(normal);
    if (cosine <= 0) continue;
    const float off = (p - target.tree.points()[at]).dot(normal);
    const float along = std::sqrt(std::max(0.0F, nearest.squared - off * off));
    const float beyond = std::max(0.0F, along - target.spacing);
    sum += cosine * std::exp(falloff * (off * off + beyond * beyond));
  }
  return sum / static_cast<float>(end - begin);
}

float AlignStep(const LaidSurface& laid, size_t count,
                const SampledSurface& target, float tau, float expected_scale,
                Similarity& place) {
  count = std::min(count, laid.points.size());
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (size_t i = 0; i < count; ++i) middle += laid.points[i];
  middle /= static_cast<float>(std::max<size_t>(1, count));
  const Eigen::Vector3f moved_middle = place.Apply(middle);
  const float sd = tau * place.scale;
  const float reach = kReach * sd;
  NormalEquations equations;
  int aligned = 0;
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f p = place.Apply(laid.points[i]);
    const PointTree::Nearest nearest =
        target.tree.FindNearest(p, reach * reach);
    if (nearest.place < 0) continue;
    const auto at = static_cast<size_t>(nearest.place);
    const Eigen::Vector3f& normal = target.normals[at];
    const float cosine = (place.rotation * laid.normals[i]).dot(normal);
    if (cosine < kMinCosine) continue;
    const Eigen::Vector3f gap = target.tree.points()[at] - p;
    const float off = gap.dot(normal);
    const float weight = cosine * std::exp(-off * off / (2 * sd * sd));
    const Eigen::Vector3f arm = p - moved_middle;
    equations.Add(Jacobian(arm, normal, place.scale), off, weight);
    for (int k = 0; k < 3; ++k) {
      equations.Add(Jacobian(arm, Eigen::Vector3f::Unit(k), place.scale),
                    gap[k], kPointToPoint * weight);
    }
    ++aligned;
  }
  if (aligned < kMinAligned) return 0;
  equations.matrix.diagonal().array() += 1e-6F * equations.matrix.trace();
  const Vector7f step =
      equations.matrix.selfadjointView<Eigen::Lower>().ldlt().solve(
          equations.right);
  return Update(step, middle, moved_middle, expected_scale, place);
}

}  // namespace argmesh
