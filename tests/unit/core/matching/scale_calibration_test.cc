#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/matching/frozen_scales.h"
#include "core/matching/match.h"
#include "tests/support/random_graph.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TEST(ComputeFrozenScales, IsTheDeviationAndMeanDistanceOfTwoNodes) {
  // Two graphs of one node each, everywhere equal but for the area.
  std::vector<ShapeGraph> graphs(
      2, MakeRandomGraph(1, {.level_nodes = {1}, .uniform_nodes = 0}));
  graphs[0].levels[0].nodes[0].tuple.log2_relative_area = -1;
  graphs[1].levels[0].nodes[0].tuple.log2_relative_area = -5;
  ASSERT_OK_AND_ASSIGN(const FrozenScales scales, ComputeFrozenScales(graphs));
  EXPECT_NEAR(scales.deviation[GroupOffset(kAreaGroup)], 2, 1e-5);
  EXPECT_NEAR(scales.component[kAreaGroup], 2, 1e-4);
  // What never varies gets a floor, what is missing 1.
  EXPECT_GT(scales.component[kWaveKernelGroup], 0);
  EXPECT_EQ(scales.uniform[kAreaGroup], 1);
}

TEST(ComputeFrozenScales, MakesTheMeanGroupDistanceOne) {
  std::vector<ShapeGraph> graphs;
  for (uint64_t seed = 0; seed < 30; ++seed) {
    graphs.push_back(MakeRandomGraph(seed));
  }
  ASSERT_OK_AND_ASSIGN(const FrozenScales scales, ComputeFrozenScales(graphs));
  // A uniform variable on (low, high): deviation w / sqrt 12, mean distance of
  // two w / 3, so their ratio is 2 / sqrt 3.
  EXPECT_NEAR(scales.component[kWaveKernelGroup], 2 / std::sqrt(3), 0.03);
  EXPECT_NEAR(scales.uniform[kWaveKernelGroup], 2 / std::sqrt(3), 0.03);
  EXPECT_NEAR(scales.deviation[GroupOffset(kWaveKernelGroup)],
              4 / std::sqrt(12), 0.05);
  EXPECT_EQ(scales.deviation[GroupOffset(kCurvednessGroup)], 1);
}

TEST(ComputeFrozenScales, CanBeMatchedWith) {
  std::vector<ShapeGraph> graphs;
  for (uint64_t seed = 0; seed < 5; ++seed) {
    graphs.push_back(MakeRandomGraph(seed));
  }
  ASSERT_OK_AND_ASSIGN(const FrozenScales scales, ComputeFrozenScales(graphs));
  const MatchableGraph a(graphs[0], scales), b(graphs[1], scales);
  const double score = MatchGlobal(a, b).score;
  EXPECT_NE(
      score,
      MatchGlobal(MatchableGraph(graphs[0]), MatchableGraph(graphs[1])).score);
  EXPECT_GT(score, 0);
}

TEST(ComputeFrozenScales, NeedsTwoGraphs) {
  const std::vector<ShapeGraph> graphs = {MakeRandomGraph(1), ShapeGraph()};
  EXPECT_THAT(
      ComputeFrozenScales(graphs),
      StatusIs(absl::StatusCode::kFailedPrecondition, HasSubstr("got 1")));
}

TEST(FormatFrozenScales, PrintsEveryNumber) {
  FrozenScales scales;
  scales.deviation.fill(1);
  scales.deviation[0] = 0.25F;
  scales.component.fill(2);
  scales.component[0] = 3;
  scales.uniform.fill(4);
  scales.partial.fill(5);
  const std::string text = FormatFrozenScales(scales);
  EXPECT_THAT(text, HasSubstr("{0.25000F, 1.00000F"));
  EXPECT_THAT(text, HasSubstr("{3.00000F, 2.00000F"));
  EXPECT_THAT(text, HasSubstr("5.00000F},\n};"));
  EXPECT_EQ(
      std::count(text.begin(), text.end(), '.'),
      static_cast<std::ptrdiff_t>(kAttributeDims + 3 * kNumAttributeGroups));
}

}  // namespace
}  // namespace argmesh
