#include "core/containment/window_descriptor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace argmesh {
namespace {

constexpr float kAxisReach = 0.35F;    // of the radius
constexpr float kSameSide = 0.2F;      // cosine of normals that make the axis
constexpr float kNoDirection = 0.02F;  // of the radius: too close to the centre

struct Sample {
  int32_t place;
  float squared;
};

// A histogram whose samples are shared between the four nearest bins.
template <size_t kRows, size_t kColumns>
class SoftGrid {
 public:
  // Coordinates in 0 .. 1.
  void Add(float row, float column, float weight) {
    const float y = Bin(row, kRows);
    const float x = Bin(column, kColumns);
    const auto i = static_cast<size_t>(y);
    const auto j = static_cast<size_t>(x);
    const float fy = y - static_cast<float>(i);
    const float fx = x - static_cast<float>(j);
    float* const cell = bins_.data() + i * kColumns + j;
    const float upper = weight * (1 - fy);
    const float lower = weight * fy;
    cell[0] += upper * (1 - fx);
    cell[1] += upper * fx;
    cell[kColumns] += lower * (1 - fx);
    cell[kColumns + 1] += lower * fx;
  }

  void TakeRoots(float* out) const {
    for (const float bin : bins_) *out++ = std::sqrt(bin);
  }

 private:
  // In units of bins, never on the last centre.
  static float Bin(float value, size_t bins) {
    const auto n = static_cast<float>(bins);
    return std::clamp(value * n - 0.5F, 0.0F, n - 1.001F);
  }

  std::array<float, kRows * kColumns> bins_{};
};

template <size_t kRows, size_t kColumns>
void ReverseRows(float* bins) {
  for (size_t row = 0; row < kRows; ++row) {
    std::reverse(bins + row * kColumns, bins + (row + 1) * kColumns);
  }
}

}  // namespace

DescribedWindow DescribeWindow(const SampleLayer& layer,
                               const Eigen::Vector3f& position,
                               const Eigen::Vector3f& normal, float radius) {
  thread_local std::vector<Sample> samples;
  samples.clear();
  layer.tree.VisitBall(position, radius, [&](int32_t place, float squared) {
    samples.push_back({place, squared});
  });
  DescribedWindow window;
  window.position = position;
  const float axis_reach = kAxisReach * kAxisReach * radius * radius;
  Eigen::Vector3f axis = Eigen::Vector3f::Zero();
  for (const Sample& sample : samples) {
    if (sample.squared > axis_reach) continue;
    const Eigen::Vector3f& n = layer.normals[static_cast<size_t>(sample.place)];
    if (n.dot(normal) > kSameSide) axis += n;
  }
  window.axis = axis.squaredNorm() > 1e-12F ? axis.normalized() : normal;

  SoftGrid<kSpinRows, kSpinColumns> spin;
  SoftGrid<kNormalRows, kNormalColumns> tilt;
  SoftGrid<kNormalRows, kNormalColumns> radial;
  const float inverse = 1 / radius;
  const float unit = inverse * inverse / static_cast<float>(layer.tree.size());
  for (const Sample& sample : samples) {
    const auto place = static_cast<size_t>(sample.place);
    const Eigen::Vector3f offset =
        (layer.tree.points()[place] - position) * inverse;
    const Eigen::Vector3f& n = layer.normals[place];
    const float d2 = sample.squared * inverse * inverse;
    const float d = std::sqrt(d2);
    const float weight = unit * (1 - d2 * d2);
    const float height = offset.dot(window.axis);
    const float outwards = d > kNoDirection ? n.dot(offset) / d : 0;
    spin.Add(std::sqrt(std::max(0.0F, d2 - height * height)), (height + 1) / 2,
             weight);
    tilt.Add(d, (n.dot(window.axis) + 1) / 2, weight);
    radial.Add(d, (outwards + 1) / 2, weight);
  }
  spin.TakeRoots(window.raw.data());
  tilt.TakeRoots(window.raw.data() + kSpinBins);
  radial.TakeRoots(window.raw.data() + kSpinBins + kNormalBins);
  return window;
}

RawDescriptor FlipDescriptor(const RawDescriptor& raw) {
  RawDescriptor flipped = raw;
  ReverseRows<kSpinRows, kSpinColumns>(flipped.data());
  ReverseRows<kNormalRows, kNormalColumns>(flipped.data() + kSpinBins +
                                           kNormalBins);
  return flipped;
}

}  // namespace argmesh
