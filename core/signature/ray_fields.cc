#include "core/signature/ray_fields.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace argmesh {
namespace {

constexpr size_t kConeRays = 30;
constexpr double kConeCosine = 0.5;
constexpr double kMinAngle = 0.15;

struct ConeRay {
  Eigen::Vector3f direction;  // z along the axis of the cone
  float weight;
};

std::array<ConeRay, kConeRays> MakeCone() {
  std::array<ConeRay, kConeRays> cone;
  for (size_t i = 0; i < kConeRays; ++i) {
    const double z =
        1 - (1 - kConeCosine) * (static_cast<double>(i) + 0.5) / kConeRays;
    const double r = std::sqrt(1 - z * z);
    const double azimuth =
        static_cast<double>(i) * (3 - std::sqrt(5.0)) * std::numbers::pi;
    cone[i].direction =
        Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), z)
            .cast<float>();
    cone[i].weight = static_cast<float>(1 / (std::acos(z) + kMinAngle));
  }
  return cone;
}

struct Hit {
  float length, weight;
};

float RobustMean(std::span<Hit> hits) {
  if (hits.empty()) return 0;
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return a.length != b.length ? a.length < b.length : a.weight < b.weight;
  });
  const float median = hits[hits.size() / 2].length;
  float squares = 0;
  for (const Hit& hit : hits) {
    squares += (hit.length - median) * (hit.length - median);
  }
  const float deviation =
      std::sqrt(squares / static_cast<float>(hits.size())) + 1e-6F;
  float sum = 0;
  float weight = 0;
  for (const Hit& hit : hits) {
    if (std::abs(hit.length - median) > deviation) continue;
    sum += hit.weight * hit.length;
    weight += hit.weight;
  }
  return sum / weight;
}

}  // namespace

RayFields CastPointRays(const RayScene& scene, const Eigen::Vector3f& point,
                        const Eigen::Vector3f& normal) {
  static const std::array<ConeRay, kConeRays> cone = MakeCone();
  Eigen::Matrix3f frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  std::array<Hit, kConeRays> hits;
  size_t count = 0;
  int occluded = 0;
  for (const ConeRay& ray : cone) {
    const Eigen::Vector3f out = frame * ray.direction;
    const Eigen::Vector3f in = out - 2 * ray.direction.z() * normal;
    if (scene.IsOccluded(point + kRayOffset * normal, out)) ++occluded;
    const auto exit = scene.FindExit(point - kRayOffset * normal, in, 0);
    if (exit) hits[count++] = {*exit, ray.weight};
  }
  return {RobustMean({hits.data(), count}),
          static_cast<float>(occluded) / static_cast<float>(kConeRays)};
}

}  // namespace argmesh
