#include "core/signature/depth_views.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace argmesh {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();
constexpr double kFill = 0.98;
constexpr float kFarValue = 0.3F;
constexpr float kSlack = 1e-5F;  // pixels on an edge belong to both faces
constexpr float kSmallestTwiceArea = 1e-9F;
constexpr int kClosingRadius = 2;

using PixelPoints = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

// The largest z and the smallest z at each pixel.
struct DepthRange {
  std::vector<float> highest, lowest;
};

// One triangle in pixels and depth.
void DrawTriangle(const Eigen::RowVector3f& a, const Eigen::RowVector3f& b,
                  const Eigen::RowVector3f& c, DepthRange& range) {
  const auto pixel_range = [](float p, float q, float r) {
    const float low = std::ceil(std::min({p, q, r}));
    const float high = std::floor(std::max({p, q, r}));
    return std::pair(std::max(0, static_cast<int>(low)),
                     std::min(kImageSize - 1, static_cast<int>(high)));
  };
  const auto [x0, x1] = pixel_range(a[0], b[0], c[0]);
  const auto [y0, y1] = pixel_range(a[1], b[1], c[1]);
  if (x0 > x1 || y0 > y1) return;
  const Eigen::RowVector3f ab = b - a;
  const Eigen::RowVector3f ac = c - a;
  const float area = ab[0] * ac[1] - ab[1] * ac[0];
  if (std::abs(area) < kSmallestTwiceArea) return;
  const float inverse = 1 / area;
  for (int y = y0; y <= y1; ++y) {
    const float dy = static_cast<float>(y) - a[1];
    const auto row = static_cast<size_t>(y * kImageSize);
    for (int x = x0; x <= x1; ++x) {
      const float dx = static_cast<float>(x) - a[0];
      const float u = (dx * ac[1] - dy * ac[0]) * inverse;
      const float v = (ab[0] * dy - ab[1] * dx) * inverse;
      if (u < -kSlack || v < -kSlack || u + v > 1 + kSlack) continue;
      const float z = a[2] + u * ab[2] + v * ac[2];
      const size_t pixel = row + static_cast<size_t>(x);
      range.highest[pixel] = std::max(range.highest[pixel], z);
      range.lowest[pixel] = std::min(range.lowest[pixel], z);
    }
  }
}

float DepthValue(float z) { return kFarValue + (1 - kFarValue) * (z + 1) / 2; }

// The running maximum over 2 kClosingRadius + 1 values at `step` apart.
template <typename Pick>
void FilterLines(const DepthImage& from, size_t step, size_t line_step,
                 Pick pick, DepthImage& to) {
  for (int line = 0; line < kImageSize; ++line) {
    const size_t start = static_cast<size_t>(line) * line_step;
    for (int i = 0; i < kImageSize; ++i) {
      const int first = std::max(0, i - kClosingRadius);
      const int last = std::min(kImageSize - 1, i + kClosingRadius);
      float value = from[start + static_cast<size_t>(first) * step];
      for (int k = first + 1; k <= last; ++k) {
        value = pick(value, from[start + static_cast<size_t>(k) * step]);
      }
      to[start + static_cast<size_t>(i) * step] = value;
    }
  }
}

}  // namespace

std::vector<Eigen::Vector3d> ViewDirections() {
  constexpr double kGolden = std::numbers::phi;
  std::vector<Eigen::Vector3d> corners;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Eigen::Vector3d corner = Eigen::Vector3d::Zero();
      corner[axis] = 1;
      corner[(axis + 1) % 3] = sign * kGolden;
      corners.push_back(corner.normalized());
    }
  }
  // With their opposites these are the twelve corners; two are joined by an
  // edge when their cosine is 1/sqrt(5).
  std::vector<Eigen::Vector3d> directions = corners;
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const double cosine = corners[i].dot(corners[j]);
      directions.push_back(
          (corners[i] + (cosine > 0 ? 1 : -1) * corners[j]).normalized());
    }
  }
  std::vector<Eigen::Vector3d> both;
  for (const Eigen::Vector3d& direction : directions) {
    both.push_back(direction);
    both.push_back(-direction);
  }
  return both;
}

DepthRenderer::DepthRenderer(const TriangleMesh& mesh) : mesh_(mesh) {
  const double radius = std::sqrt(mesh.V.rowwise().squaredNorm().maxCoeff());
  if (radius > 0) scale_ = kFill / radius;
}

std::array<DepthImage, 2> DepthRenderer::Render(
    const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d up = std::abs(direction[2]) > 0.95
                                 ? Eigen::Vector3d::UnitX()
                                 : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d frame;  // rows: right, up, towards the viewer
  frame.row(0) = up.cross(direction).normalized().transpose();
  frame.row(1) = direction.cross(frame.row(0).transpose()).transpose();
  frame.row(2) = direction.transpose();
  constexpr double kHalf = kImageSize / 2.0;
  PixelPoints points =
      ((mesh_.V * frame.transpose()) * scale_).template cast<float>();
  points.col(0) = (points.col(0).array() + 1) * kHalf - 0.5F;
  points.col(1) = (1 - points.col(1).array()) * kHalf - 0.5F;
  constexpr size_t kPixels = size_t{kImageSize} * kImageSize;
  DepthRange range{std::vector<float>(kPixels, kNothing),
                   std::vector<float>(kPixels, -kNothing)};
  for (Eigen::Index f = 0; f < mesh_.F.rows(); ++f) {
    DrawTriangle(points.row(mesh_.F(f, 0)), points.row(mesh_.F(f, 1)),
                 points.row(mesh_.F(f, 2)), range);
  }
  std::array<DepthImage, 2> images{DepthImage(kPixels, 0),
                                   DepthImage(kPixels, 0)};
  for (size_t pixel = 0; pixel < kPixels; ++pixel) {
    if (range.highest[pixel] == kNothing) continue;
    images[0][pixel] = DepthValue(range.highest[pixel]);
    // Seen from behind, right is left.
    const size_t mirrored =
        pixel - pixel % kImageSize + (kImageSize - 1 - pixel % kImageSize);
    images[1][mirrored] = DepthValue(-range.lowest[pixel]);
  }
  return images;
}

void CloseImage(DepthImage& image) {
  DepthImage other(image.size());
  const auto larger = [](float a, float b) { return std::max(a, b); };
  const auto smaller = [](float a, float b) { return std::min(a, b); };
  FilterLines(image, 1, kImageSize, larger, other);
  FilterLines(other, kImageSize, 1, larger, image);
  FilterLines(image, 1, kImageSize, smaller, other);
  FilterLines(other, kImageSize, 1, smaller, image);
}

DepthImage HalveImage(const DepthImage& image, int size) {
  const auto width = static_cast<size_t>(size);
  DepthImage half;
  half.reserve(image.size() / 4);
  for (size_t y = 0; y < width; y += 2) {
    for (size_t x = 0; x < width; x += 2) {
      const size_t at = y * width + x;
      half.push_back((image[at] + image[at + 1] + image[at + width] +
                      image[at + width + 1]) /
                     4);
    }
  }
  return half;
}

}  // namespace argmesh
