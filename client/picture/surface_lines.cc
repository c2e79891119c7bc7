#include "client/picture/surface_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace argmesh {
namespace {

constexpr double kColorLine = 0.78;
constexpr double kOutline = 0.55;
constexpr double kDepthLine = 0.45;
constexpr float kDepthJump = 9.0F;  // pixels between neighbouring subpixels

// How dark a line between the two is on the side of `own`: lines belong to
// the nearer surface.
double LineStrength(const SubpixelGrid::Subpixel& own,
                    const SubpixelGrid::Subpixel& other) {
  if (own.key < 0) return 0;
  if (other.key < 0) return kOutline;
  if (other.key != own.key) return kColorLine;
  return own.z - other.z > kDepthJump ? kDepthLine : 0;
}

double StrengthAt(const SubpixelGrid& grid, int column, int row) {
  constexpr std::array<std::array<int, 2>, 8> kNear = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
  const SubpixelGrid::Subpixel& own = grid.At(column, row);
  double strongest = 0;
  for (const auto& [dx, dy] : kNear) {
    strongest =
        std::max(strongest, LineStrength(own, grid.At(column + dx, row + dy)));
  }
  for (const auto& [dx, dy] : kNear) {
    if (dx != 0 && dy != 0) continue;
    const double wide =
        LineStrength(own, grid.At(column + 2 * dx, row + 2 * dy));
    if (wide == kColorLine) strongest = std::max(strongest, wide);
  }
  return strongest;
}

}  // namespace

SubpixelGrid::SubpixelGrid(int width, int height)
    : width_(width), height_(height) {
  const auto pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  subpixels_.resize(pixels * kSub * kSub);
  plain_.assign(pixels, 1);
}

size_t SubpixelGrid::Pixel(int x, int y) const {
  return static_cast<size_t>(y) * static_cast<size_t>(width_) +
         static_cast<size_t>(x);
}

void SubpixelGrid::Set(int x, int y, int i, Subpixel subpixel) {
  plain_[Pixel(x, y)] = 0;
  subpixels_[Pixel(x, y) * kSub * kSub + static_cast<size_t>(i)] = subpixel;
}

void SubpixelGrid::Fill(int x, int y, int32_t key, float z) {
  const auto begin =
      subpixels_.begin() + static_cast<ptrdiff_t>(Pixel(x, y) * kSub * kSub);
  std::fill_n(begin, kSub * kSub, Subpixel{key, z});
}

const SubpixelGrid::Subpixel& SubpixelGrid::At(int column, int row) const {
  column = std::clamp(column, 0, width_ * kSub - 1);
  row = std::clamp(row, 0, height_ * kSub - 1);
  const auto in_pixel = static_cast<size_t>(row % kSub * kSub + column % kSub);
  return subpixels_[Pixel(column / kSub, row / kSub) * kSub * kSub + in_pixel];
}

void DrawLinesOfRow(const SubpixelGrid& grid, int y, Image& image) {
  constexpr int kSub = SubpixelGrid::kSub;
  for (int x = 0; x < image.width(); ++x) {
    if (grid.IsPlain(x, y)) continue;
    double sum = 0;
    for (int i = 0; i < kSub * kSub; ++i) {
      sum += StrengthAt(grid, x * kSub + i % kSub, y * kSub + i / kSub);
    }
    if (sum > 0) image.Blend(x, y, kInk, sum / (kSub * kSub));
  }
}

}  // namespace argmesh
