#include "core/geometry/point_tree.h"

#include <algorithm>
#include <numeric>

namespace argmesh {
namespace {

constexpr int32_t kLeafSize = 10;

}  // namespace

PointTree::PointTree(std::span<const Eigen::Vector3f> points)
    : numbers_(points.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0);
  if (points.empty()) return;
  nodes_.reserve(points.size() / 2 + 1);
  Build(points, 0, static_cast<int32_t>(points.size()));
  points_.reserve(points.size());
  for (const int32_t number : numbers_) {
    points_.push_back(points[static_cast<size_t>(number)]);
  }
}

void PointTree::Build(std::span<const Eigen::Vector3f> points, int32_t begin,
                      int32_t end) {
  const size_t self = nodes_.size();
  Node node;
  node.begin = begin;
  node.end = end;
  const auto point = [&](int32_t number) -> const Eigen::Vector3f& {
    return points[static_cast<size_t>(number)];
  };
  node.low = node.high = point(numbers_[static_cast<size_t>(begin)]);
  for (int32_t i = begin + 1; i < end; ++i) {
    const Eigen::Vector3f& x = point(numbers_[static_cast<size_t>(i)]);
    node.low = node.low.cwiseMin(x);
    node.high = node.high.cwiseMax(x);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return;
  Eigen::Index axis = 0;
  (node.high - node.low).maxCoeff(&axis);
  const int32_t middle = begin + (end - begin) / 2;
  std::nth_element(numbers_.begin() + begin, numbers_.begin() + middle,
                   numbers_.begin() + end, [&](int32_t a, int32_t b) {
                     const float x = point(a)[axis];
                     const float y = point(b)[axis];
                     return x != y ? x < y : a < b;
                   });
  Build(points, begin, middle);
  nodes_[self].right = static_cast<int32_t>(nodes_.size());
  Build(points, middle, end);
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
