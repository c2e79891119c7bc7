#include "core/signature/patch_histograms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace argmesh {
namespace {

constexpr int kCells = 4;  // on a side
constexpr int kDirections = 8;
constexpr int kAngleBins = 36;
constexpr int kAngleSmoothing = 4;
constexpr float kMaxShare = 0.2F;  // of one bin, then normalised again
constexpr float kSmallestLength = 1e-6F;

struct PixelBox {
  int x0, x1, y0, y1;
};

PixelBox BoxAround(const GradientImage& gradients, const Patch& patch,
                   float reach) {
  const auto low = [](float v) {
    return std::max(0, static_cast<int>(std::ceil(v)));
  };
  const auto high = [&](float v) {
    return std::min(gradients.size - 1, static_cast<int>(std::floor(v)));
  };
  return {low(patch.x - reach), high(patch.x + reach), low(patch.y - reach),
          high(patch.y + reach)};
}

// The strongest direction in the disc inside the patch, in turns.
std::optional<float> DominantAngle(const GradientImage& gradients,
                                   const Patch& patch) {
  const float radius = patch.side / 2;
  const float falloff = -1 / (2 * (0.75F * radius) * (0.75F * radius));
  std::array<float, kAngleBins> bins{};
  const PixelBox box = BoxAround(gradients, patch, radius);
  for (int y = box.y0; y <= box.y1; ++y) {
    const float dy = static_cast<float>(y) - patch.y;
    for (int x = box.x0; x <= box.x1; ++x) {
      const auto pixel = static_cast<size_t>(y * gradients.size + x);
      const float magnitude = gradients.magnitude[pixel];
      const float dx = static_cast<float>(x) - patch.x;
      const float squared = dx * dx + dy * dy;
      if (magnitude <= 0 || squared > radius * radius) continue;
      const float place = gradients.angle[pixel] * kAngleBins;
      const auto bin = std::min(static_cast<int>(place), kAngleBins - 1);
      const float share = place - static_cast<float>(bin);
      const float weight = magnitude * std::exp(squared * falloff);
      bins[static_cast<size_t>(bin)] += weight * (1 - share);
      bins[static_cast<size_t>((bin + 1) % kAngleBins)] += weight * share;
    }
  }
  const auto at = [&bins](int bin) {
    return bins[static_cast<size_t>((bin + kAngleBins) % kAngleBins)];
  };
  for (int round = 0; round < kAngleSmoothing; ++round) {
    std::array<float, kAngleBins> smooth;
    for (int bin = 0; bin < kAngleBins; ++bin) {
      smooth[static_cast<size_t>(bin)] =
          (at(bin - 1) + at(bin) + at(bin + 1)) / 3;
    }
    bins = smooth;
  }
  const auto peak = static_cast<int>(
      std::max_element(bins.begin(), bins.end()) - bins.begin());
  if (at(peak) <= 0) return std::nullopt;
  const float bend = at(peak - 1) - 2 * at(peak) + at(peak + 1);
  const float shift =
      bend != 0 ? 0.5F * (at(peak - 1) - at(peak + 1)) / bend : 0;
  return (static_cast<float>(peak) + shift) / kAngleBins;
}

// With a margin of one cell, so that no pixel needs a test of its cells.
constexpr int kPaddedCells = kCells + 2;
using PaddedHistogram =
    std::array<float, size_t{kPaddedCells} * kPaddedCells * kDirections>;

void FillHistogram(const GradientImage& gradients, const Patch& patch,
                   float angle, PaddedHistogram& histogram) {
  const float radians = angle * 2 * std::numbers::pi_v<float>;
  const float cosine = std::cos(radians) * kCells / patch.side;
  const float sine = std::sin(radians) * kCells / patch.side;
  const float half = patch.side / 2;
  const float falloff = -1 / (2 * half * half);
  constexpr float kMiddle = (kCells + 1) / 2.0F;  // in padded cells
  const PixelBox box =
      BoxAround(gradients, patch, half * std::numbers::sqrt2_v<float>);
  for (int y = box.y0; y <= box.y1; ++y) {
    const float dy = static_cast<float>(y) - patch.y;
    for (int x = box.x0; x <= box.x1; ++x) {
      const auto pixel = static_cast<size_t>(y * gradients.size + x);
      const float magnitude = gradients.magnitude[pixel];
      if (magnitude <= 0) continue;
      const float dx = static_cast<float>(x) - patch.x;
      const float u = cosine * dx + sine * dy + kMiddle;
      const float v = cosine * dy - sine * dx + kMiddle;
      if (u <= 0 || v <= 0 || u >= kCells + 1 || v >= kCells + 1) continue;
      float turns = gradients.angle[pixel] - angle;
      turns -= std::floor(turns);
      const float place = turns * kDirections;
      const int whole = static_cast<int>(place);
      const auto low = static_cast<size_t>(whole % kDirections);
      const auto high = static_cast<size_t>((whole + 1) % kDirections);
      const float turn_share = place - static_cast<float>(whole);
      const int column = static_cast<int>(u);
      const int row = static_cast<int>(v);
      const float right = u - static_cast<float>(column);
      const float down = v - static_cast<float>(row);
      const float weight = magnitude * std::exp((dx * dx + dy * dy) * falloff);
      float* const cell =
          histogram.data() +
          static_cast<size_t>((row * kPaddedCells + column) * kDirections);
      const auto add = [&](size_t offset, float share) {
        cell[offset + low] += share * (1 - turn_share);
        cell[offset + high] += share * turn_share;
      };
      add(0, weight * (1 - right) * (1 - down));
      add(kDirections, weight * right * (1 - down));
      add(size_t{kPaddedCells} * kDirections, weight * (1 - right) * down);
      add(size_t{kPaddedCells + 1} * kDirections, weight * right * down);
    }
  }
}

}  // namespace

GradientImage ComputeGradients(const std::vector<float>& image, int size) {
  GradientImage gradients;
  gradients.size = size;
  gradients.magnitude.assign(image.size(), 0);
  gradients.angle.assign(image.size(), 0);
  for (int y = 0; y < size; ++y) {
    const int above = std::max(0, y - 1) * size;
    const int below = std::min(size - 1, y + 1) * size;
    for (int x = 0; x < size; ++x) {
      const auto at = [&image](int pixel) {
        return image[static_cast<size_t>(pixel)];
      };
      const float gx = at(y * size + std::min(size - 1, x + 1)) -
                       at(y * size + std::max(0, x - 1));
      const float gy = at(below + x) - at(above + x);
      if (gx == 0 && gy == 0) continue;
      const auto pixel = static_cast<size_t>(y * size + x);
      gradients.magnitude[pixel] = std::sqrt(gx * gx + gy * gy);
      const float turns = std::atan2(gy, gx) / (2 * std::numbers::pi_v<float>);
      gradients.angle[pixel] = turns < 0 ? turns + 1 : turns;
    }
  }
  return gradients;
}

bool DescribePatch(const GradientImage& gradients, const Patch& patch,
                   Eigen::Ref<Eigen::RowVectorXf> histogram) {
  const std::optional<float> angle = DominantAngle(gradients, patch);
  if (!angle) return false;
  PaddedHistogram padded{};
  FillHistogram(gradients, patch, *angle, padded);
  Eigen::Matrix<float, 1, kPatchDims> inner;
  Eigen::Index next = 0;
  for (int row = 1; row <= kCells; ++row) {
    for (int column = 1; column <= kCells; ++column) {
      for (int d = 0; d < kDirections; ++d) {
        inner[next++] = padded[static_cast<size_t>(
            (row * kPaddedCells + column) * kDirections + d)];
      }
    }
  }
  const float length = inner.norm();
  if (length < kSmallestLength) return false;
  inner = (inner / length).cwiseMin(kMaxShare);
  histogram = (inner / inner.sum()).cwiseSqrt();
  return true;
}

}  // namespace argmesh
