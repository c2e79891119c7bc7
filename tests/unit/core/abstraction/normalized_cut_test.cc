#include "core/abstraction/normalized_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace argmesh {
namespace {

// Two cliques of three nodes joined by one weak edge 2-3.
CutProblem MakeTwoCliques(double bridge) {
  CutProblem problem;
  problem.weights = Eigen::MatrixXd::Zero(6, 6);
  for (int base : {0, 3}) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (i != j) problem.weights(base + i, base + j) = 1;
      }
    }
  }
  problem.weights(2, 3) = problem.weights(3, 2) = bridge;
  problem.masses = Eigen::VectorXd::Constant(6, 1.0 / 6);
  return problem;
}

TEST(BuildCutTree, CutsTheWeakBridgeFirstAtItsClosedFormValue) {
  const std::vector<CutNode> tree = BuildCutTree(MakeTwoCliques(0.1));
  EXPECT_EQ(tree.size(), 11U);  // 6 leaves, 5 cuts
  EXPECT_NEAR(tree[0].ncut, 0.1 * 2 / std::sqrt(0.5), 1e-12);
  EXPECT_EQ(tree[static_cast<size_t>(tree[0].children[0])].regions,
            (std::vector<int32_t>{0, 1, 2}));
  EXPECT_EQ(tree[static_cast<size_t>(tree[0].children[1])].regions,
            (std::vector<int32_t>{3, 4, 5}));
}

TEST(BuildCutTree, SeparatesDisconnectedPartsAtNoCost) {
  const std::vector<CutNode> tree = BuildCutTree(MakeTwoCliques(0));
  EXPECT_NEAR(tree[0].ncut, 0, 1e-12);
  EXPECT_EQ(tree[static_cast<size_t>(tree[0].children[0])].regions,
            (std::vector<int32_t>{0, 1, 2}));
}

TEST(BuildCutTree, OfOneNodeIsALeaf) {
  CutProblem problem;
  problem.weights = Eigen::MatrixXd::Zero(1, 1);
  problem.masses = Eigen::VectorXd::Ones(1);
  const std::vector<CutNode> tree = BuildCutTree(problem);
  ASSERT_EQ(tree.size(), 1U);
  EXPECT_EQ(tree[0].ncut, std::numeric_limits<double>::infinity());
}

TEST(BuildCutTree, ValueDoesNotChangeWithTheScaleOfLengthAndArea) {
  CutProblem problem = MakeTwoCliques(0.3);
  const double value = BuildCutTree(problem)[0].ncut;
  problem.weights *= 7;     // lengths times 7,
  problem.masses *= 7 * 7;  // areas times 49
  EXPECT_NEAR(BuildCutTree(problem)[0].ncut, value, 1e-12);
}

TEST(CutLevels, NestAndNeverShrink) {
  constexpr uint64_t kSeed = 77;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  CutProblem problem;
  problem.weights = Eigen::MatrixXd::Zero(20, 20);
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < i; ++j) {
      if (random.Uniform() < 0.3) {
        problem.weights(i, j) = problem.weights(j, i) = random.Uniform();
      }
    }
  }
  problem.masses = Eigen::VectorXd::Constant(20, 0.05);
  const std::vector<DecompositionLevel> levels =
      CutLevels(BuildCutTree(problem), {0.5, 1, 2, 4}, {8, 16, 64});
  ASSERT_EQ(levels.size(), 7U);
  EXPECT_EQ(levels.back().num_components, 20);
  for (size_t l = 1; l < levels.size(); ++l) {
    EXPECT_GE(levels[l].num_components, levels[l - 1].num_components);
    for (size_t r = 0; r < 20; ++r) {
      const auto component =
          static_cast<size_t>(levels[l].component_of_region[r]);
      EXPECT_EQ(levels[l].parent[component],
                levels[l - 1].component_of_region[r]);
    }
  }
}

}  // namespace
}  // namespace argmesh
