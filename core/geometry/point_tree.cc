#include "core/geometry/point_tree.h"

#include <algorithm>
#include <cstddef>

namespace argmesh {
namespace {

constexpr int32_t kPointsPerLeaf = 10;

}  // namespace

PointTree::PointTree(std::span<const Eigen::Vector3f> points) {
  if (points.empty()) return;
  std::vector<NumberedPoint> numbered;
  numbered.reserve(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    numbered.push_back({points[i], static_cast<int32_t>(i)});
  }
  nodes_.reserve(points.size() / 2 + 1);
  Build(numbered, 0, static_cast<int32_t>(points.size()));
  points_.reserve(points.size());
  numbers_.reserve(points.size());
  for (const NumberedPoint& point : numbered) {
    points_.push_back(point.position);
    numbers_.push_back(point.number);
  }
}

void PointTree::Build(std::span<NumberedPoint> points, int32_t begin,
                      int32_t end) {
  const size_t self = nodes_.size();
  Node node;
  node.begin = begin;
  node.end = end;
  node.low = node.high = points.front().position;
  for (const NumberedPoint& point : points) {
    node.low = node.low.cwiseMin(point.position);
    node.high = node.high.cwiseMax(point.position);
  }
  nodes_.push_back(node);
  if (end - begin <= kPointsPerLeaf) return;
  Eigen::Index axis = 0;
  (node.high - node.low).maxCoeff(&axis);
  const size_t half = points.size() / 2;
  std::nth_element(
      points.begin(), points.begin() + static_cast<std::ptrdiff_t>(half),
      points.end(), [axis](const NumberedPoint& a, const NumberedPoint& b) {
        const float x = a.position[axis];
        const float y = b.position[axis];
        return x != y ? x < y : a.number < b.number;
      });
  const int32_t middle = begin + static_cast<int32_t>(half);
  Build(points.first(half), begin, middle);
  nodes_[self].right = static_cast<int32_t>(nodes_.size());
  Build(points.subspan(half), middle, end);
}

PointTree::Nearest PointTree::FindNearest(const Eigen::Vector3f& query,
                                          float limit_squared) const {
  Nearest best{-1, limit_squared};
  if (nodes_.empty()) return best;
  struct Entry {
    int32_t node;
    float squared;
  };
  std::array<Entry, kMaxDepth> stack;
  size_t depth = 0;
  stack[depth++] = {0, SquaredToBox(nodes_[0], query)};
  while (depth > 0) {
    const Entry entry = stack[--depth];
    if (entry.squared >= best.squared) continue;
    const Node& node = nodes_[static_cast<size_t>(entry.node)];
    if (node.right > 0) {
      Entry near{entry.node + 1, 0};
      Entry far{node.right, 0};
      near.squared =
          SquaredToBox(nodes_[static_cast<size_t>(near.node)], query);
      far.squared = SquaredToBox(nodes_[static_cast<size_t>(far.node)], query);
      if (far.squared < near.squared) std::swap(near, far);
      stack[depth++] = far;
      stack[depth++] = near;
      continue;
    }
    for (int32_t i = node.begin; i < node.end; ++i) {
      const float squared =
          (points_[static_cast<size_t>(i)] - query).squaredNorm();
      if (squared < best.squared) best = {i, squared};
    }
  }
  return best;
}

}  // namespace argmesh
