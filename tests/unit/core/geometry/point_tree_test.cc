#include "core/geometry/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/random.h"

namespace argmesh {
namespace {

std::vector<Eigen::Vector3f> RandomPoints(size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector3f> points(count);
  for (Eigen::Vector3f& point : points) {
    for (int k = 0; k < 3; ++k) {
      point[k] = static_cast<float>(random.Uniform(-1, 1));
    }
  }
  return points;
}

TEST(PointTree, FindsWhatTryingAllPointsFinds) {
  for (const size_t count : {1u, 2u, 11u, 500u}) {
    const std::vector<Eigen::Vector3f> points = RandomPoints(count, count);
    const PointTree tree(points);
    for (const Eigen::Vector3f& query : RandomPoints(50, 7)) {
      float best = 0.25F;
      int32_t nearest = -1;
      for (size_t i = 0; i < count; ++i) {
        const float squared = (points[i] - query).squaredNorm();
        if (squared < best) {
          best = squared;
          nearest = static_cast<int32_t>(i);
        }
      }
      const PointTree::Nearest found = tree.FindNearest(query, 0.25F);
      ASSERT_EQ(found.place < 0, nearest < 0);
      if (nearest < 0) continue;
      EXPECT_EQ(tree.numbers()[static_cast<size_t>(found.place)], nearest);
      EXPECT_EQ(found.squared, best);
    }
  }
}

TEST(PointTree, VisitsExactlyTheBall) {
  const std::vector<Eigen::Vector3f> points = RandomPoints(700, 3);
  const PointTree tree(points);
  for (const Eigen::Vector3f& center : RandomPoints(20, 4)) {
    std::vector<int32_t> visited;
    tree.VisitBall(center, 0.4F, [&](int32_t place, float squared) {
      visited.push_back(tree.numbers()[static_cast<size_t>(place)]);
      EXPECT_EQ(
          squared,
          (tree.points()[static_cast<size_t>(place)] - center).squaredNorm());
    });
    std::sort(visited.begin(), visited.end());
    std::vector<int32_t> expected;
    for (size_t i = 0; i < points.size(); ++i) {
      if ((points[i] - center).squaredNorm() <= 0.4F * 0.4F) {
        expected.push_back(static_cast<int32_t>(i));
      }
    }
    EXPECT_EQ(visited, expected);
  }
}

TEST(PointTree, HoldsManyPointsInOnePlace) {
  const std::vector<Eigen::Vector3f> points(1000, Eigen::Vector3f::Ones());
  const PointTree tree(points);
  int visited = 0;
  tree.VisitBall(Eigen::Vector3f::Ones(), 0,
                 [&](int32_t, float) { ++visited; });
  EXPECT_EQ(visited, 1000);
}

TEST(PointTree, OfNothingFindsNothing) {
  const PointTree tree;
  EXPECT_EQ(tree.FindNearest(Eigen::Vector3f::Zero(), 1e9F).place, -1);
  tree.VisitBall(Eigen::Vector3f::Zero(), 1, [](int32_t, float) { FAIL(); });
}

}  // namespace
}  // namespace argmesh
