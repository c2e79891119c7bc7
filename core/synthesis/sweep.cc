#include "core/synthesis/sweep.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace argmesh {
namespace {

template <typename T>
T CatmullRom(const T& p0, const T& p1, const T& p2, const T& p3, double t) {
  return 0.5 * (2.0 * p1 + (p2 - p0) * t +
                (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * (t * t) +
                (3.0 * p1 - p0 - 3.0 * p2 + p3) * (t * t * t));
}

// The neighbours of span i..i+1 in a curve of n points.
struct SpanPoints {
  size_t p0, p1, p2, p3;
};

SpanPoints PointsOfSpan(size_t i, size_t n, bool closed) {
  if (closed) return {(i + n - 1) % n, i, (i + 1) % n, (i + 2) % n};
  return {i == 0 ? 0 : i - 1, i, i + 1, std::min(i + 2, n - 1)};
}

}  // namespace

void AddSweep(ImplicitSurface& surface, std::span<const SweepKnot> knots,
              const SweepOptions& options) {
  const size_t n = knots.size();
  const size_t spans = options.closed ? n : n - 1;
  SweepKnot last = knots[0];
  std::vector<Primitive> tube;
  for (size_t i = 0; i < spans; ++i) {
    const auto [p0, p1, p2, p3] = PointsOfSpan(i, n, options.closed);
    for (int piece = 1; piece <= options.pieces; ++piece) {
      const double t = static_cast<double>(piece) / options.pieces;
      SweepKnot next;
      next.point =
          CatmullRom<Eigen::Vector3d>(knots[p0].point, knots[p1].point,
                                      knots[p2].point, knots[p3].point, t);
      next.radius = (1 - t) * knots[p1].radius + t * knots[p2].radius;
      tube.push_back(
          MakeCapsule(last.point, next.point, last.radius, next.radius));
      last = next;
    }
  }
  surface.AddUnion(std::move(tube), options.blend);
}

Outline SmoothCurve(const Outline& points, int pieces, bool closed) {
  const size_t n = points.size();
  const size_t spans = closed ? n : n - 1;
  Outline curve;
  for (size_t i = 0; i < spans; ++i) {
    const auto [p0, p1, p2, p3] = PointsOfSpan(i, n, closed);
    for (int piece = 0; piece < pieces; ++piece) {
      const double t = static_cast<double>(piece) / pieces;
      curve.push_back(CatmullRom<Eigen::Vector2d>(points[p0], points[p1],
                                                  points[p2], points[p3], t));
    }
  }
  if (!closed) curve.push_back(points.back());
  return curve;
}

Outline CircleOutline(const Eigen::Vector2d& center, double radius,
                      int points) {
  Outline outline;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    outline.emplace_back(center.x() + radius * std::cos(angle),
                         center.y() + radius * std::sin(angle));
  }
  return outline;
}

Outline RectangleOutline(const Eigen::Vector2d& low,
                         const Eigen::Vector2d& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

}  // namespace argmesh
