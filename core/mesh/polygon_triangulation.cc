#include "core/mesh/polygon_triangulation.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"

namespace argmesh {
namespace {

// More of them would make a polygon of many coinciding corners cost the cube
// of its valence.
constexpr int kMaxRefreshes = 4;

void WriteTriangle(std::span<int32_t> triangles, size_t triangle, int32_t a,
                   int32_t b, int32_t c) {
  triangles[3 * triangle] = a;
  triangles[3 * triangle + 1] = b;
  triangles[3 * triangle + 2] = c;
}

void WriteFan(std::span<const int32_t> polygon, std::span<int32_t> triangles) {
  for (size_t i = 2; i < polygon.size(); ++i) {
    WriteTriangle(triangles, i - 2, polygon[0], polygon[i - 1], polygon[i]);
  }
}

}  // namespace

PolygonTriangulator::PolygonTriangulator(std::span<const double> coordinates,
                                         int64_t max_tests)
    : coordinates_(coordinates), tests_left_(max_tests) {}

absl::Status PolygonTriangulator::Triangulate(std::span<const int32_t> polygon,
                                              std::span<int32_t> triangles) {
  if (polygon.size() == 3) {
    WriteTriangle(triangles, 0, polygon[0], polygon[1], polygon[2]);
    return absl::OkStatus();
  }
  if (!Project(polygon)) {
    ++num_irregular_;
    WriteFan(polygon, triangles);
    return absl::OkStatus();
  }
  if (FanIsValid()) {
    WriteFan(polygon, triangles);
    return absl::OkStatus();
  }
  return ClipEars(polygon, triangles);
}

// Drops the axis along which the Newell normal is largest, keeping the sense
// of rotation counter-clockwise. False when the polygon has no area.
bool PolygonTriangulator::Project(std::span<const int32_t> polygon) {
  const auto at = [&](size_t corner, size_t axis) {
    return coordinates_[3 * static_cast<size_t>(polygon[corner]) + axis];
  };
  // Relative to the first corner, so that a position far from the origin costs
  // no digits.
  std::array<double, 3> normal = {0, 0, 0};
  double extent = 0;
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    std::array<double, 3> p;
    std::array<double, 3> q;
    for (size_t axis = 0; axis < 3; ++axis) {
      p[axis] = at(i, axis) - at(0, axis);
      q[axis] = at(i + 1, axis) - at(0, axis);
      extent = std::max({extent, std::abs(p[axis]), std::abs(q[axis])});
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t u = (axis + 1) % 3;
      const size_t v = (axis + 2) % 3;
      normal[axis] += p[u] * q[v] - p[v] * q[u];
    }
  }
  size_t axis = 0;
  for (size_t other = 1; other < 3; ++other) {
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  }
  constexpr double kRelativeCross = 1e-14;
  smallest_cross_ = kRelativeCross * extent * extent;
  if (!(std::abs(normal[axis]) > smallest_cross_)) return false;

  size_t u = (axis + 1) % 3;
  size_t v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  points_.resize(polygon.size());
  for (size_t i = 0; i < polygon.size(); ++i) {
    points_[i] = {at(i, u) - at(0, u), at(i, v) - at(0, v)};
  }
  return true;
}

// Twice the signed area of the triangle.
double PolygonTriangulator::Cross(size_t a, size_t b, size_t c) const {
  const Point& p = points_[a];
  const Point& q = points_[b];
  const Point& r = points_[c];
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

bool PolygonTriangulator::FanIsValid() const {
  for (size_t i = 2; i < points_.size(); ++i) {
    if (!(Cross(0, i - 1, i) > smallest_cross_)) return false;
  }
  return true;
}

void PolygonTriangulator::Link() {
  const size_t valence = points_.size();
  refreshes_left_ = kMaxRefreshes;
  previous_.resize(valence);
  next_.resize(valence);
  is_strictly_convex_.assign(valence, 0);
  is_ear_.assign(valence, 0);
  for (size_t i = 0; i < valence; ++i) {
    previous_[i] = (i + valence - 1) % valence;
    next_[i] = (i + 1) % valence;
  }
  for (size_t i = 0; i < valence; ++i) {
    is_strictly_convex_[i] =
        Cross(previous_[i], i, next_[i]) > smallest_cross_ ? 1 : 0;
  }
  for (size_t i = 0; i < valence; ++i) is_ear_[i] = IsEar(i) ? 1 : 0;
}

// A strictly convex corner whose triangle holds no other corner. Only corners
// that are not strictly convex can be in the way.
bool PolygonTriangulator::IsEar(size_t corner) {
  if (is_strictly_convex_[corner] == 0) return false;
  const size_t a = previous_[corner];
  const size_t c = next_[corner];
  for (size_t i = next_[c]; i != a; i = next_[i]) {
    --tests_left_;
    if (is_strictly_convex_[i] != 0) continue;
    const Point& p = points_[i];
    if (p == points_[a] || p == points_[corner] || p == points_[c]) continue;
    if (Cross(a, corner, i) >= 0 && Cross(corner, c, i) >= 0 &&
        Cross(c, a, i) >= 0) {
      return false;
    }
  }
  return true;
}

void PolygonTriangulator::UpdateCorner(size_t corner) {
  const double cross = Cross(previous_[corner], corner, next_[corner]);
  is_strictly_convex_[corner] = cross > smallest_cross_ ? 1 : 0;
  is_ear_[corner] = IsEar(corner) ? 1 : 0;
}

void PolygonTriangulator::Unlink(size_t corner) {
  next_[previous_[corner]] = next_[corner];
  previous_[next_[corner]] = previous_[corner];
}

// The first ear from `start` on; `points_.size()` when there is none. A corner
// may have become an ear behind our back only where corners are collinear or
// coincide, so the flags are refreshed before giving up, a few times.
size_t PolygonTriangulator::FindEar(size_t start, size_t left) {
  for (const bool refresh : {false, true}) {
    if (refresh && --refreshes_left_ < 0) break;
    size_t corner = start;
    for (size_t i = 0; i < left; ++i, corner = next_[corner]) {
      if (refresh) UpdateCorner(corner);
      if (is_ear_[corner] != 0) return corner;
    }
    tests_left_ -= static_cast<int64_t>(left);
  }
  return points_.size();
}

absl::Status PolygonTriangulator::ClipEars(std::span<const int32_t> polygon,
                                           std::span<int32_t> triangles) {
  Link();
  size_t start = 0;
  bool has_ears = true;
  for (size_t left = polygon.size(); left >= 3; --left) {
    size_t ear = start;
    if (has_ears && left > 3) ear = FindEar(start, left);
    if (ear == points_.size()) {
      // No simple polygon: a fan around the corner before `start` fills it.
      has_ears = false;
      ++num_irregular_;
      ear = start;
    }
    if (tests_left_ < 0) {
      return absl::ResourceExhaustedError(absl::StrFormat(
          "polygon of %d vertices: too many tests to triangulate the polygons "
          "of this file",
          polygon.size()));
    }
    const size_t before = previous_[ear];
    const size_t after = next_[ear];
    WriteTriangle(triangles, polygon.size() - left, polygon[before],
                  polygon[ear], polygon[after]);
    Unlink(ear);
    start = after;
    if (!has_ears) continue;
    UpdateCorner(before);
    UpdateCorner(after);
    start = next_[after];
  }
  return absl::OkStatus();
}

}  // namespace argmesh
