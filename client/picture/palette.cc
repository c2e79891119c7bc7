#include "client/picture/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "client/picture/image.h"

namespace argmesh {
namespace {

constexpr size_t kColors = 48;

double Linear(uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double LabCurve(double t) {
  return t > 216.0 / 24389.0 ? std::cbrt(t)
                             : (24389.0 / 27.0 * t + 16.0) / 116.0;
}

// Candidates: a lattice of sRGB without near-white, near-black and greys.
std::vector<RgbColor> MakeCandidates() {
  std::vector<RgbColor> candidates;
  constexpr int kStep = 15;
  for (int r = 30; r <= 255; r += kStep) {
    for (int g = 30; g <= 255; g += kStep) {
      for (int b = 30; b <= 255; b += kStep) {
        const RgbColor color = {static_cast<uint8_t>(r),
                                static_cast<uint8_t>(g),
                                static_cast<uint8_t>(b)};
        const Eigen::Vector3d lab = LabOfRgb(color);
        if (lab[0] < 40 || lab[0] > 86) continue;
        if (lab.tail<2>().norm() < 28) continue;
        candidates.push_back(color);
      }
    }
  }
  return candidates;
}

std::array<RgbColor, kColors> MakePalette() {
  constexpr std::array<RgbColor, 8> kFirst = {{{230, 159, 0},
                                               {86, 180, 233},
                                               {0, 158, 115},
                                               {240, 228, 66},
                                               {0, 114, 178},
                                               {213, 94, 0},
                                               {204, 121, 167},
                                               {96, 104, 124}}};
  const std::vector<RgbColor> candidates = MakeCandidates();
  std::vector<Eigen::Vector3d> labs;
  labs.reserve(candidates.size());
  for (const RgbColor& color : candidates) labs.push_back(LabOfRgb(color));
  std::vector<double> nearest(candidates.size());
  const Eigen::Vector3d grey = LabOfRgb(kPaleGrey);
  for (size_t i = 0; i < labs.size(); ++i) nearest[i] = (labs[i] - grey).norm();
  std::array<RgbColor, kColors> palette;
  for (size_t n = 0; n < kColors; ++n) {
    if (n < kFirst.size()) {
      palette[n] = kFirst[n];
    } else {
      const auto best = std::max_element(nearest.begin(), nearest.end());
      palette[n] = candidates[static_cast<size_t>(best - nearest.begin())];
    }
    const Eigen::Vector3d taken = LabOfRgb(palette[n]);
    for (size_t i = 0; i < labs.size(); ++i) {
      nearest[i] = std::min(nearest[i], (labs[i] - taken).norm());
    }
  }
  return palette;
}

}  // namespace

Eigen::Vector3d LabOfRgb(RgbColor color) {
  const double r = Linear(color[0]);
  const double g = Linear(color[1]);
  const double b = Linear(color[2]);
  const double x =
      LabCurve((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
  const double y = LabCurve(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
  const double z =
      LabCurve((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double ColorDifference(RgbColor a, RgbColor b) {
  return (LabOfRgb(a) - LabOfRgb(b)).norm();
}

RgbColor CategoricalColor(int index) {
  static const std::array<RgbColor, kColors> palette = MakePalette();
  return palette[static_cast<size_t>(index) % kColors];
}

std::vector<RgbColor> ColorsOfLabels(std::span<const int32_t> labels) {
  std::vector<RgbColor> colors;
  colors.reserve(labels.size());
  for (const int32_t label : labels) {
    colors.push_back(label < 0 ? kPaleGrey : CategoricalColor(label));
  }
  return colors;
}

RgbColor ScaleColor(double value) {
  constexpr std::array<std::array<double, 3>, 5> kStops = {{{255, 255, 255},
                                                            {198, 219, 239},
                                                            {107, 174, 214},
                                                            {33, 113, 181},
                                                            {8, 40, 90}}};
  const double at = std::clamp(value, 0.0, 1.0) * (kStops.size() - 1);
  const auto low = std::min(static_cast<size_t>(at), kStops.size() - 2);
  const double share = at - static_cast<double>(low);
  RgbColor color;
  for (size_t c = 0; c < 3; ++c) {
    color[c] = static_cast<uint8_t>(
        std::lround((1 - share) * kStops[low][c] + share * kStops[low + 1][c]));
  }
  return color;
}

}  // namespace argmesh
