#include "core/signature/view_patches.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/base/status_macros.h"
#include "core/signature/codebook.h"
#include "core/signature/depth_views.h"
#include "core/signature/patch_histograms.h"

namespace argmesh {
namespace {

constexpr int kPatchesOfView = 72;

// Shares of the image. Sides above a quarter of it are described at half the
// resolution: their cells are still more than four pixels wide.
struct PatchSize {
  double side;
  bool halved;
};
constexpr std::array<PatchSize, 3> kSizes = {
    PatchSize{0.1875, false}, PatchSize{0.28, true}, PatchSize{0.42, true}};

// Appends rows from `row` on; returns the row after the last one.
Eigen::Index DescribeView(const DepthImage& image, Eigen::Index row,
                          PointRows& patches) {
  std::vector<int32_t> shape;
  for (size_t pixel = 0; pixel < image.size(); ++pixel) {
    if (image[pixel] > 0) shape.push_back(static_cast<int32_t>(pixel));
  }
  if (shape.empty()) return row;
  constexpr int kHalf = kImageSize / 2;
  const GradientImage full = ComputeGradients(image, kImageSize);
  const GradientImage half =
      ComputeGradients(HalveImage(image, kImageSize), kHalf);
  Eigen::RowVectorXf histogram(kPatchDims);
  constexpr float kMiddle = (kImageSize - 1) / 2.0F;
  for (int k = 0; k < kPatchesOfView; ++k) {
    // One pixel in each of as many equal parts of the shape, spread inside
    // them by multiples of the golden ratio.
    const double jitter = std::fmod(k * std::numbers::phi, 1.0);
    const auto pixel = shape[static_cast<size_t>(
        (k + jitter) / kPatchesOfView * static_cast<double>(shape.size()))];
    const PatchSize& size = kSizes[static_cast<size_t>(k) % kSizes.size()];
    const int column = pixel % kImageSize;
    const int line = pixel / kImageSize;
    Patch patch{static_cast<float>(column), static_cast<float>(line),
                static_cast<float>(size.side * kImageSize)};
    if (size.halved) {
      patch = {(patch.x - 0.5F) / 2, (patch.y - 0.5F) / 2, patch.side / 2};
    }
    if (!DescribePatch(size.halved ? half : full, patch, histogram)) continue;
    const float dx = static_cast<float>(column) - kMiddle;
    const float dy = static_cast<float>(line) - kMiddle;
    patches.row(row++) << histogram, std::hypot(dx, dy) / kMiddle,
        image[static_cast<size_t>(pixel)];
  }
  return row;
}

}  // namespace

absl::StatusOr<PointRows> DescribeViews(const SignatureSurface& surface,
                                        const StopToken& stop) {
  static const std::vector<Eigen::Vector3d> directions = ViewDirections();
  const DepthRenderer renderer(surface.mesh);
  PointRows patches(
      static_cast<Eigen::Index>(directions.size()) * kPatchesOfView,
      kPatchDims + kPlaceDims);
  Eigen::Index rows = 0;
  for (size_t d = 0; d < directions.size(); d += 2) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    for (DepthImage& image : renderer.Render(directions[d])) {
      CloseImage(image);
      rows = DescribeView(image, rows, patches);
    }
  }
  patches.conservativeResize(rows, Eigen::NoChange);
  return patches;
}

}  // namespace argmesh
