#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/matching/match.h"
#include "core/matching/packed_graph.h"
#include "core/matching/partial_level.h"
#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

using ::testing::IsEmpty;

// A shape cut so that `num_nodes` of its finest level are left, at a scale
// that changed with it.
ShapeGraph CutGraph(const ShapeGraph& graph, int num_nodes, float scale) {
  ShapeGraph cut;
  cut.levels = {CutLevel(graph.levels.back(), num_nodes)};
  for (ArgNode& node : cut.levels[0].nodes) node.parent = -1;
  for (float& distance : cut.levels[0].distances) distance *= scale;
  return cut;
}

TEST(MatchPartial, ScoresEqualGraphsExactlyOne) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const MatchableGraph a(MakeRandomGraph(seed)), b(MakeRandomGraph(seed));
    const MatchResult result = MatchPartial(a, b);
    EXPECT_EQ(result.score, 1.0) << seed;
    EXPECT_EQ(result.best_level, "count-16") << seed;
    EXPECT_EQ(result.query_coverage, 1.0) << seed;
    EXPECT_EQ(result.target_coverage, 1.0) << seed;
  }
}

TEST(MatchPartial, FindsThePartInTheShapeItWasCutFromAtAnyScale) {
  for (uint64_t seed = 0; seed < 25; ++seed) {
    const ShapeGraph whole = MakeRandomGraph(seed);
    const MatchableGraph part(CutGraph(whole, 5, 1.7F));
    const MatchResult found = MatchPartial(part, MatchableGraph(whole));
    EXPECT_NEAR(found.score, 1, 1e-5) << seed;
    EXPECT_EQ(found.best_target_level, 3) << seed;
    EXPECT_EQ(found.query_coverage, 1) << seed;
    EXPECT_LT(found.target_coverage, 1) << seed;
    ASSERT_EQ(found.pairs.size(), 5u) << seed;
    for (const NodePair& pair : found.pairs) {
      EXPECT_EQ(pair.query_node, pair.target_node) << seed;
    }
    const MatchResult other =
        MatchPartial(part, MatchableGraph(MakeRandomGraph(seed + 100)));
    EXPECT_LT(other.score, 0.9) << seed;
  }
}

TEST(MatchPartial, TakesTheBestOfTheLevelsAskedFor) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const MatchableGraph a(MakeRandomGraph(seed));
    const MatchableGraph b(MakeRandomGraph(seed + 1000));
    for (const LevelScore& level : MatchPartial(a, b).level_scores) {
      const MatchResult alone = MatchPartial(a, b, {.levels = {level.name}});
      ASSERT_EQ(alone.level_scores.size(), 1u) << seed;
      EXPECT_EQ(alone.best_level, level.name) << seed;
      EXPECT_EQ(alone.level_scores[0].score, level.score) << seed;
    }
  }
}

TEST(MatchPartial, DoesNotScoreAWholeInsideItsPart) {
  const ShapeGraph whole =
      MakeRandomGraph(1, {.level_nodes = {10}, .uniform_nodes = 0, .modes = 0});
  const MatchResult result = MatchPartial(
      MatchableGraph(whole), MatchableGraph(CutGraph(whole, 4, 1)));
  EXPECT_EQ(result.score, 0);
  EXPECT_THAT(result.level_scores, IsEmpty());
}

TEST(MatchPartial, UsesALevelOfOneNodeOnlyWhenThereIsNoOther) {
  const ShapeGraph target = MakeRandomGraph(2);
  ShapeGraph query = MakeRandomGraph(
      3, {.level_nodes = {1, 4}, .uniform_nodes = 0, .modes = 0});
  // Its only coarse node is to be found in the target as it is.
  query.levels[0].nodes[0] = target.levels[0].nodes[0];
  query.levels[0].nodes[0].area = 1;
  const MatchResult several =
      MatchPartial(MatchableGraph(query), MatchableGraph(target));
  EXPECT_LT(several.score, 0.9);
  EXPECT_NE(several.best_query_level, 0);
  query.levels.pop_back();
  const MatchResult single =
      MatchPartial(MatchableGraph(query), MatchableGraph(target));
  EXPECT_EQ(single.score, 1);
}

TEST(MatchPartial, CountsOnlyNodesThatAreFound) {
  const ShapeGraph whole = MakeRandomGraph(4);
  ShapeGraph query = CutGraph(whole, 4, 1);
  ArgNode& strange = query.levels[0].nodes[3];
  strange.tuple.gauss_mean += 40;
  const MatchableGraph packed(query), target(whole);
  const PartialLevelMatch match =
      MatchPartialLevel(packed.impl().levels[0], target.impl().levels.back());
  ASSERT_EQ(match.pairs.size(), 3u);
  const double missing = static_cast<double>(query.levels[0].nodes[3].area);
  EXPECT_NEAR(match.query_coverage, 1 - missing, 1e-5);
  EXPECT_NEAR(match.score, 1 - missing, 1e-4);
}

TEST(MatchPartial, LowersTheScoreOfNodesThatLieElsewhere) {
  const ShapeGraph whole = MakeRandomGraph(5);
  ShapeGraph query = CutGraph(whole, 5, 1);
  query.levels[0].distances[0] *= 4;
  query.levels[0].distances[3] /= 4;
  const MatchableGraph packed(query), target(whole);
  const PartialLevelMatch match =
      MatchPartialLevel(packed.impl().levels[0], target.impl().levels.back());
  EXPECT_EQ(match.query_coverage, 1);
  EXPECT_LT(match.score, 0.99);
  EXPECT_GT(match.score, 0.7);
}

TEST(MatchPartial, IgnoresWhatCuttingChanges) {
  const ShapeGraph whole = MakeRandomGraph(6);
  ShapeGraph query = CutGraph(whole, 4, 1);
  for (ArgNode& node : query.levels[0].nodes) {
    node.histograms.outer_distance = {1};
    node.histograms.average_geodesic = {1};
    node.histograms.shape_diameter = {1};
    node.histograms.curvedness = {1};
    node.wave_kernel.fill(0);
  }
  EXPECT_NEAR(MatchPartial(MatchableGraph(query), MatchableGraph(whole)).score,
              1, 1e-5);
}

}  // namespace
}  // namespace argmesh
