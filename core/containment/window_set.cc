#include "core/containment/window_set.h"

#include <algorithm>
#include <cmath>

namespace argmesh {
namespace {

constexpr float kNormalStep = 1.0F / 127;

float SignOf(float x) { return x < 0 ? -1.0F : 1.0F; }

int8_t RoundNormal(float x) {
  return static_cast<int8_t>(
      std::lround(std::clamp(x, -1.0F, 1.0F) / kNormalStep));
}

}  // namespace

PackedPoint PackPoint(const Eigen::Vector3f& position,
                      const Eigen::Vector3f& normal) {
  PackedPoint packed;
  for (int k = 0; k < 3; ++k) {
    packed.position[static_cast<size_t>(k)] = static_cast<int16_t>(std::lround(
        std::clamp(position[k] / kPositionStep, -32767.0F, 32767.0F)));
  }
  // The octahedron |x| + |y| + |z| = 1 seen from above, its lower half folded
  // outwards over the corners of the square.
  const float sum = normal.lpNorm<1>();
  if (!(sum > 0)) return packed;
  Eigen::Vector2f folded = normal.head<2>() / sum;
  if (normal.z() < 0) {
    folded = {(1 - std::abs(folded.y())) * SignOf(folded.x()),
              (1 - std::abs(folded.x())) * SignOf(folded.y())};
  }
  packed.normal = {RoundNormal(folded.x()), RoundNormal(folded.y())};
  return packed;
}

Eigen::Vector3f UnpackPosition(const PackedPoint& point) {
  return kPositionStep * Eigen::Vector3f(point.position[0], point.position[1],
                                         point.position[2]);
}

Eigen::Vector3f UnpackNormal(const PackedPoint& point) {
  const float x = kNormalStep * static_cast<float>(point.normal[0]);
  const float y = kNormalStep * static_cast<float>(point.normal[1]);
  Eigen::Vector3f normal(x, y, 1 - std::abs(x) - std::abs(y));
  if (normal.z() < 0) {
    normal.x() = (1 - std::abs(y)) * SignOf(x);
    normal.y() = (1 - std::abs(x)) * SignOf(y);
  }
  return normal.normalized();
}

}  // namespace argmesh
