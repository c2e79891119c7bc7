#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/matching/level_similarity.h"
#include "core/matching/match.h"
#include "core/matching/packed_graph.h"
#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> Names(const MatchResult& result) {
  std::vector<std::string> names;
  for (const LevelScore& level : result.level_scores) {
    names.push_back(level.name);
  }
  return names;
}

RandomGraphOptions OptionsOf(uint64_t seed) {
  const std::vector<std::vector<int>> levels = {
      {2, 4, 6, 10}, {1, 3, 3, 7}, {5}, {1, 1, 2, 2, 16}};
  return {.level_nodes = levels[seed % levels.size()],
          .uniform_nodes = seed % 5 == 4 ? 0 : 8 + static_cast<int>(seed % 7)};
}

TEST(MatchGlobal, ScoresEqualGraphsExactlyOne) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    for (const auto attributes : {AttributeSet::kFull, AttributeSet::kTuple}) {
      const MatchableGraph a(MakeRandomGraph(seed, OptionsOf(seed)));
      const MatchableGraph b(MakeRandomGraph(seed, OptionsOf(seed)));
      const MatchResult result = MatchGlobal(a, b, {.attributes = attributes});
      EXPECT_EQ(result.score, 1.0) << seed;
      for (const LevelScore& level : result.level_scores) {
        EXPECT_EQ(level.score, 1.0F) << seed << " " << level.name;
      }
      EXPECT_EQ(result.query_coverage, 1.0) << seed;
      EXPECT_EQ(result.target_coverage, 1.0) << seed;
      for (const NodePair& pair : result.pairs) {
        EXPECT_EQ(pair.query_node, pair.target_node) << seed;
        EXPECT_EQ(pair.similarity, 1.0F) << seed;
      }
    }
  }
}

TEST(MatchGlobal, IsSymmetricToTheBit) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const MatchableGraph a(MakeRandomGraph(seed, OptionsOf(seed)));
    const MatchableGraph b(MakeRandomGraph(seed + 1000, OptionsOf(seed / 4)));
    const MatchResult ab = MatchGlobal(a, b);
    const MatchResult ba = MatchGlobal(b, a);
    EXPECT_EQ(ab.score, ba.score) << seed;
    ASSERT_EQ(ab.level_scores.size(), ba.level_scores.size()) << seed;
    for (size_t l = 0; l < ab.level_scores.size(); ++l) {
      EXPECT_EQ(ab.level_scores[l].score, ba.level_scores[l].score) << seed;
    }
    EXPECT_EQ(ab.query_coverage, ba.target_coverage) << seed;
    EXPECT_EQ(ab.pairs.size(), ba.pairs.size()) << seed;
    EXPECT_GE(ab.score, 0) << seed;
    EXPECT_LT(ab.score, 1) << seed;
  }
}

TEST(MatchGlobal, CountsOnlyTheLevelsAskedFor) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const MatchableGraph a(MakeRandomGraph(seed));
    const MatchableGraph b(MakeRandomGraph(seed + 1000));
    for (const LevelScore& level : MatchGlobal(a, b).level_scores) {
      const MatchResult alone = MatchGlobal(a, b, {.levels = {level.name}});
      ASSERT_EQ(alone.level_scores.size(), 1u) << seed;
      EXPECT_EQ(alone.level_scores[0].name, level.name) << seed;
      EXPECT_FLOAT_EQ(static_cast<float>(alone.score), level.score) << seed;
      EXPECT_EQ(alone.best_level, level.name) << seed;
    }
    EXPECT_EQ(MatchGlobal(a, b, {.levels = {"none"}}).score, 0) << seed;
  }
}

TEST(MatchGlobal, FallsWithTheAmountOfChange) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const ShapeGraph graph = MakeRandomGraph(seed);
    const MatchableGraph query(graph);
    double before = 1;
    for (const float amount : {0.001F, 0.01F, 0.1F}) {
      const MatchableGraph moved(PerturbGraph(graph, amount, seed + 77));
      const double score = MatchGlobal(query, moved).score;
      EXPECT_LT(score, before) << seed << " " << amount;
      before = score;
    }
    const MatchableGraph other(MakeRandomGraph(seed + 500));
    EXPECT_LT(MatchGlobal(query, other).score, before) << seed;
  }
}

TEST(MatchGlobal, IsHalfTheMeanOfTheComponentLevelsAndHalfTheUniformLevel) {
  const MatchResult result = MatchGlobal(MatchableGraph(MakeRandomGraph(1)),
                                         MatchableGraph(MakeRandomGraph(2)));
  ASSERT_THAT(Names(result), ElementsAre("ncut-1.6", "ncut-2", "ncut-2.4",
                                         "count-16", "uniform"));
  const auto score = [&result](size_t level) {
    return static_cast<double>(result.level_scores[level].score);
  };
  const double components = (score(0) + score(1) + score(2) + score(3)) / 4;
  EXPECT_NEAR(result.score, (components + score(4)) / 2, 1e-6);
}

TEST(MatchGlobal, NamesTheBestLevelAndItsIndex) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const ShapeGraph graph = MakeRandomGraph(seed);
    const MatchResult result =
        MatchGlobal(MatchableGraph(graph),
                    MatchableGraph(PerturbGraph(graph, 0.05F, seed)));
    const auto best = static_cast<size_t>(result.best_query_level);
    ASSERT_LT(best, result.level_scores.size());
    EXPECT_EQ(result.level_scores[best].name, result.best_level) << seed;
    for (const LevelScore& level : result.level_scores) {
      EXPECT_LE(level.score, result.level_scores[best].score) << seed;
    }
  }
}

TEST(MatchGlobal, DoesNotExplainWithALevelOfOneNode) {
  ShapeGraph a = MakeRandomGraph(1, {.level_nodes = {1, 4}});
  ShapeGraph b = MakeRandomGraph(2, {.level_nodes = {1, 4}});
  b.levels[0] = a.levels[0];
  const MatchResult result = MatchGlobal(MatchableGraph(a), MatchableGraph(b));
  EXPECT_EQ(result.level_scores[0].score, 1);
  EXPECT_NE(result.best_query_level, 0);
}

TEST(MatchGlobal, MeetsTheFinestLevelsOfHierarchiesOfDifferentDepth) {
  const ShapeGraph deep = MakeRandomGraph(3, {.level_nodes = {2, 4, 6}});
  ShapeGraph shallow = deep;
  shallow.levels = {deep.levels[2]};
  for (ArgNode& node : shallow.levels[0].nodes) node.parent = -1;
  const MatchResult result =
      MatchGlobal(MatchableGraph(deep), MatchableGraph(shallow));
  EXPECT_EQ(result.score, 1);
  EXPECT_EQ(result.best_query_level, 2);
  EXPECT_EQ(result.best_target_level, 0);
}

TEST(MatchGlobal, ScoresWhatLevelsThereAre) {
  const ShapeGraph full = MakeRandomGraph(4);
  ShapeGraph no_cells = full;
  no_cells.uniform = ArgLevel();
  const MatchResult result =
      MatchGlobal(MatchableGraph(full), MatchableGraph(no_cells));
  EXPECT_EQ(result.score, 1);
  EXPECT_EQ(result.level_scores.size(), full.levels.size());
  const MatchResult nothing =
      MatchGlobal(MatchableGraph(full), MatchableGraph(ShapeGraph()));
  EXPECT_EQ(nothing.score, 0);
  EXPECT_THAT(nothing.level_scores, IsEmpty());
  EXPECT_THAT(nothing.pairs, IsEmpty());
}

TEST(MatchGlobal, LooksAtTheTupleAloneWhenAsked) {
  const ShapeGraph graph = MakeRandomGraph(5);
  ShapeGraph moved = graph;
  for (ArgNode& node : moved.levels.back().nodes) node.wave_kernel[3] += 1;
  for (ArgNode& node : moved.uniform.nodes) node.wave_kernel[3] += 1;
  const MatchableGraph a(graph), b(moved);
  EXPECT_LT(MatchGlobal(a, b).score, 1);
  EXPECT_EQ(MatchGlobal(a, b, {.attributes = AttributeSet::kTuple}).score, 1);
}

TEST(MatchGlobal, LeavesTheCorrespondenceOutWhenNotAsked) {
  const MatchableGraph a(MakeRandomGraph(6)), b(MakeRandomGraph(7));
  const MatchResult with = MatchGlobal(a, b);
  const MatchResult without = MatchGlobal(a, b, {.correspondence = false});
  EXPECT_FALSE(with.pairs.empty());
  EXPECT_TRUE(without.pairs.empty());
  EXPECT_EQ(with.score, without.score);
}

TEST(ScoreLevels, OfOneNodeEachIsTheirSimilarity) {
  ShapeGraph a = MakeRandomGraph(8, {.level_nodes = {1}});
  ShapeGraph b = MakeRandomGraph(9, {.level_nodes = {1}});
  const MatchableGraph pa(a), pb(b);
  const PackedLevel& x = pa.impl().levels[0];
  const PackedLevel& y = pb.impl().levels[0];
  double distance = 0;
  for (size_t k = 0; k < kFullWidth; ++k) {
    distance += static_cast<double>(std::abs(x.full[k] - y.full[k]));
  }
  EXPECT_NEAR(ScoreLevels(x, y, RowKind::kFull), std::exp(-distance / 0.4),
              1e-6);
}

// Two nodes against one like both: each of the two finds it, but only one can
// have it.
TEST(ScoreLevels, IsTheMeanOfOneToOneAndNearest) {
  ShapeGraph one = MakeRandomGraph(11, {.level_nodes = {1}});
  ShapeGraph two = MakeRandomGraph(12, {.level_nodes = {2}});
  for (ArgNode& node : two.levels[0].nodes) {
    const float area = node.area;
    node = one.levels[0].nodes[0];
    node.area = area;
  }
  const MatchableGraph pa(one), pb(two);
  const PackedLevel& x = pa.impl().levels[0];
  const PackedLevel& y = pb.impl().levels[0];
  const double larger = static_cast<double>(std::max(y.weight[0], y.weight[1]));
  const double one_to_one = (1 + larger) / 2;
  EXPECT_NEAR(ScoreLevels(x, y, RowKind::kFull), (one_to_one + 1) / 2, 1e-6);
}

TEST(MatchableGraph, MeasuresTheWeightedMeanOfGroupDistances) {
  ShapeGraph a = MakeRandomGraph(10, {.level_nodes = {1}});
  ShapeGraph b = a;
  b.levels[0].nodes[0].wave_kernel[2] += 0.5F;
  b.levels[0].nodes[0].tuple.log2_relative_area -= 1;
  const FrozenScales& scales = DefaultFrozenScales();
  const double wave =
      0.5 /
      static_cast<double>(scales.deviation[GroupOffset(kWaveKernelGroup) + 2]) /
      16 / static_cast<double>(scales.component[kWaveKernelGroup]);
  const double area =
      1 / static_cast<double>(scales.deviation[GroupOffset(kAreaGroup)]) /
      static_cast<double>(scales.component[kAreaGroup]);
  // Weights: seven groups of 1, tuple and area of 1/2 each.
  const double distance = wave / 8 + area * 0.5 / 8;
  const MatchableGraph pa(a), pb(b);
  EXPECT_NEAR(
      ScoreLevels(pa.impl().levels[0], pb.impl().levels[0], RowKind::kFull),
      std::exp(-distance / 0.4), 1e-5);
}

}  // namespace
}  // namespace argmesh
