// A kd-tree over points in space: the nearest one, and all in a ball.
//
// Points are kept in the order of the tree, so that those near each other lie
// near each other in memory.
//
// Repeats  equal points give equal answers, visited in an equal order.
// Cost     O(n log n) to build, O(log n) a nearest point. Immutable,
//          thread-safe.
#ifndef ARGMESH_CORE_GEOMETRY_POINT_TREE_H_
#define ARGMESH_CORE_GEOMETRY_POINT_TREE_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace argmesh {

class PointTree {
 public:
  PointTree() = default;  // no points
  explicit PointTree(std::span<const Eigen::Vector3f> points);

  size_t size() const { return points_.size(); }
  // By place in the tree: the position and the number it was given with.
  const std::vector<Eigen::Vector3f>& points() const { return points_; }
  const std::vector<int32_t>& numbers() const { return numbers_; }

  struct Nearest {
    int32_t place = -1;  // -1: none
    float squared = 0;
  };
  // The nearest point closer than sqrt(`limit_squared`).
  Nearest FindNearest(const Eigen::Vector3f& query, float limit_squared) const;

  // visit(place, squared distance) for every point within `radius`.
  template <typename Visit>
  void VisitBall(const Eigen::Vector3f& center, float radius,
                 Visit&& visit) const;

 private:
  static constexpr size_t kMaxDepth = 64;

  struct Node {
    Eigen::Vector3f low, high;
    // Places of a leaf; of an inner node right > 0 and left + 1 is this one's
    // own left child.
    int32_t begin = 0, end = 0;
    int32_t right = 0;
  };

  struct NumberedPoint {
    Eigen::Vector3f position;
    int32_t number;
  };

  // `points` are those of places begin .. end-1 and are put in order.
  void Build(std::span<NumberedPoint> points, int32_t begin, int32_t end);
  float SquaredToBox(const Node& node, const Eigen::Vector3f& query) const {
    return (node.low - query)
        .cwiseMax(query - node.high)
        .cwiseMax(0.0F)
        .squaredNorm();
  }

  std::vector<Node> nodes_;
  std::vector<Eigen::Vector3f> points_;
  std::vector<int32_t> numbers_;
};

template <typename Visit>
void PointTree::VisitBall(const Eigen::Vector3f& center, float radius,
                          Visit&& visit) const {
  if (nodes_.empty()) return;
  const float limit = radius * radius;
  std::array<int32_t, kMaxDepth> stack;
  size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const int32_t index = stack[--depth];
    const Node& node = nodes_[static_cast<size_t>(index)];
    if (SquaredToBox(node, center) > limit) continue;
    if (node.right > 0) {
      stack[depth++] = node.right;
      stack[depth++] = index + 1;
      continue;
    }
    for (int32_t i = node.begin; i < node.end; ++i) {
      const float squared =
          (points_[static_cast<size_t>(i)] - center).squaredNorm();
      if (squared <= limit) visit(i, squared);
    }
  }
}

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_POINT_TREE_H_
