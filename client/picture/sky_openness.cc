#include "client/picture/sky_openness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "client/picture/parallel_rows.h"
#include "core/base/random.h"

namespace argmesh {
namespace {

using Eigen::Vector3f;

constexpr int kBlurRadius = 3;  // cells
constexpr float kLift = 0.5F;   // pixels off the surface, against self-hits
constexpr float kReachShare = 0.4F;  // of the picture's smaller side

// Two unit vectors orthogonal to n and each other.
void Tangents(const Vector3f& n, Vector3f& u, Vector3f& v) {
  const Vector3f helper =
      std::abs(n.x()) < 0.7F ? Vector3f::UnitX() : Vector3f::UnitY();
  u = n.cross(helper).normalized();
  v = n.cross(u);
}

// Cosine-distributed about +z: the i-th of n points of a rotated spiral.
Vector3f SkyDirection(int i, int n, float turn) {
  const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(n);
  const float radius = std::sqrt(share);
  const float angle = 2.39996323F * static_cast<float>(i) + turn;
  return {radius * std::cos(angle), radius * std::sin(angle),
          std::sqrt(1 - share)};
}

}  // namespace

SkyOpenness::SkyOpenness(const RayScene& scene, const SurfaceShader& shader,
                         std::span<const RayHit> hits,
                         const std::optional<GroundPlane>& ground,
                         const RenderOptions& options)
    : scene_(scene),
      shader_(shader),
      hits_(hits),
      ground_(ground),
      options_(options),
      columns_((options.width + 1) / 2),
      rows_((options.height + 1) / 2) {
  const auto count = static_cast<size_t>(columns_) * static_cast<size_t>(rows_);
  cells_.resize(count);
  smooth_.assign(count, 1.0F);
  if (options.ambient_rays == 0) return;
  ParallelRows(rows_, options.threads, [this](int row) { MeasureRow(row); });
  ParallelRows(rows_, options.threads, [this](int row) { SmoothRow(row); });
}

float SkyOpenness::At(int x, int y) const {
  return smooth_[static_cast<size_t>(y / 2) * static_cast<size_t>(columns_) +
                 static_cast<size_t>(x / 2)];
}

// The first pixel of the cell that shows the mesh; else its first pixel.
const RayHit* SkyOpenness::HitOfCell(int column, int row, int& x,
                                     int& y) const {
  for (int i = 0; i < 4; ++i) {
    x = 2 * column + i % 2;
    y = 2 * row + i / 2;
    if (x >= options_.width || y >= options_.height) continue;
    const RayHit& hit =
        hits_[static_cast<size_t>(y) * static_cast<size_t>(options_.width) +
              static_cast<size_t>(x)];
    if (hit.face >= 0) return &hit;
  }
  x = 2 * column;
  y = 2 * row;
  return nullptr;
}

void SkyOpenness::Measure(int column, int row, Cell& cell) const {
  int x = 0;
  int y = 0;
  const RayHit* hit = HitOfCell(column, row, x, y);
  Vector3f at(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, 0);
  if (hit != nullptr) {
    at.z() = hit->z;
    cell.normal = shader_.Normal(*hit);
  } else if (ground_ && ground_->normal.z() > 0.05F) {
    at.z() = (ground_->offset - ground_->normal.dot(at)) / ground_->normal.z();
    cell.normal = ground_->normal;
  } else {
    return;
  }
  cell.z = at.z();
  const auto number =
      static_cast<uint64_t>(row) * static_cast<uint64_t>(columns_) +
      static_cast<uint64_t>(column);
  Random random(options_.ambient_seed * 0x9E3779B97F4A7C15ULL + number);
  const auto turn = static_cast<float>(random.Uniform(0, 2 * std::numbers::pi));
  const float reach = kReachShare * static_cast<float>(std::min(
                                        options_.width, options_.height));
  Vector3f u;
  Vector3f v;
  Tangents(cell.normal, u, v);
  int open = 0;
  for (int i = 0; i < options_.ambient_rays; ++i) {
    const Vector3f d = SkyDirection(i, options_.ambient_rays, turn);
    const Vector3f direction = d.x() * u + d.y() * v + d.z() * cell.normal;
    const Vector3f origin = at + (cell.normal + Vector3f::UnitZ()) * kLift;
    if (!scene_.Occluded(origin, direction, reach)) ++open;
  }
  cell.openness =
      static_cast<float>(open) / static_cast<float>(options_.ambient_rays);
}

void SkyOpenness::MeasureRow(int row) {
  for (int column = 0; column < columns_; ++column) {
    Measure(column, row,
            cells_[static_cast<size_t>(row) * static_cast<size_t>(columns_) +
                   static_cast<size_t>(column)]);
  }
}

void SkyOpenness::SmoothRow(int row) {
  for (int column = 0; column < columns_; ++column) {
    const auto index =
        static_cast<size_t>(row) * static_cast<size_t>(columns_) +
        static_cast<size_t>(column);
    const Cell& cell = cells_[index];
    if (cell.normal.isZero()) continue;
    float sum = 0;
    float weights = 0;
    for (int j = std::max(row - kBlurRadius, 0);
         j <= std::min(row + kBlurRadius, rows_ - 1); ++j) {
      for (int i = std::max(column - kBlurRadius, 0);
           i <= std::min(column + kBlurRadius, columns_ - 1); ++i) {
        const Cell& other =
            cells_[static_cast<size_t>(j) * static_cast<size_t>(columns_) +
                   static_cast<size_t>(i)];
        const float facing = cell.normal.dot(other.normal);
        // A neighbour a step aside on a slope may be this much deeper.
        const float step =
            static_cast<float>(std::abs(i - column) + std::abs(j - row)) * 2 /
            std::max(cell.normal.z(), 0.15F);
        if (facing < 0.6F || std::abs(other.z - cell.z) > step + 2) continue;
        sum += facing * other.openness;
        weights += facing;
      }
    }
    smooth_[index] = weights > 0 ? sum / weights : cell.openness;
  }
}

}  // namespace argmesh
