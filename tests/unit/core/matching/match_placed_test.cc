#include "core/matching/match_placed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::IsEmpty;

MATCHER_P2(Pairs, query_node, target_node, "") {
  return arg.query_node == query_node && arg.target_node == target_node;
}

// Levels of the given numbers of nodes; node n of one level has the parent
// n modulo the number of nodes before.
ShapeGraph GraphOf(const std::vector<int>& level_nodes) {
  ShapeGraph graph = MakeRandomGraph(1, {level_nodes, 0, 0});
  for (size_t l = 1; l < graph.levels.size(); ++l) {
    const int above = graph.levels[l - 1].num_nodes();
    for (int n = 0; n < graph.levels[l].num_nodes(); ++n) {
      graph.levels[l].nodes[static_cast<size_t>(n)].parent = n % above;
    }
  }
  return graph;
}

using Overlay = std::vector<std::array<int32_t, 2>>;

TEST(MatchPlaced, PairsWhatLiesOnEachOtherHoweverUnlike) {
  const ShapeGraph query = GraphOf({3});
  const ShapeGraph target = GraphOf({5});
  const FaceLabels query_labels = {{0, 1, 2}, {}};
  const FaceLabels target_labels = {{4, 2, 0, 1}, {}};
  MatchResult match;
  match.score = 0.25;
  match.pairs = {{0, 0, 1.0F}};
  MatchPlaced({query, query_labels}, {target, target_labels},
              Overlay{{0, 0}, {1, 1}, {2, 2}}, {}, match);
  EXPECT_THAT(match.pairs, ElementsAre(Pairs(0, 4), Pairs(1, 2), Pairs(2, 0)));
  EXPECT_THAT(match.pairs[0].similarity, FloatEq(1));
  EXPECT_EQ(match.best_query_level, 0);
  EXPECT_EQ(match.best_level, LevelNames(query)[0]);
  EXPECT_EQ(match.score, 0.25);
}

TEST(MatchPlaced, SharesAreOfBothAreasAndOnlyOfWhatIsLaidOn) {
  const ShapeGraph query = GraphOf({2});
  const ShapeGraph target = GraphOf({2});
  const FaceLabels labels = {{0, 1}, {}};
  MatchResult match;
  // Three of four samples of node 0 lie on node 0, one on node 1; of node 1
  // one lies on node 1, one on nothing.
  MatchPlaced({query, labels}, {target, labels},
              Overlay{{0, 0}, {0, 0}, {0, 0}, {0, 1}, {1, 1}, {1, -1}}, {},
              match);
  ASSERT_THAT(match.pairs, ElementsAre(Pairs(0, 0), Pairs(1, 1)));
  EXPECT_THAT(match.pairs[0].similarity, FloatEq(3.0F / 4));
  EXPECT_THAT(match.pairs[1].similarity, FloatEq(1.0F / 3));
}

TEST(MatchPlaced, TakesTheFinestLevelsThatAgree) {
  const ShapeGraph query = GraphOf({2, 4});
  const ShapeGraph target = GraphOf({1, 2, 4});
  const FaceLabels labels = {{0, 1, 2, 3}, {}};
  MatchResult match;
  const Overlay same = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  MatchPlaced({query, labels}, {target, labels}, same, {}, match);
  EXPECT_EQ(match.best_query_level, 1);
  EXPECT_EQ(match.best_target_level, 2);
  EXPECT_EQ(match.pairs.size(), 4U);
  // Each of the finest lies half on the one, half on the other of two.
  const Overlay mixed = {{0, 0}, {0, 2}, {2, 0}, {2, 2},
                         {1, 1}, {1, 3}, {3, 1}, {3, 3}};
  const ShapeGraph other = GraphOf({2, 4});
  MatchPlaced({query, labels}, {other, labels}, mixed, {}, match);
  EXPECT_EQ(match.best_query_level, 0);
  EXPECT_EQ(match.best_target_level, 0);
  EXPECT_THAT(match.pairs, ElementsAre(Pairs(0, 0), Pairs(1, 1)));
}

TEST(MatchPlaced, KeepsToTheLevelsThatCount) {
  const ShapeGraph graph = GraphOf({2, 4});
  const FaceLabels labels = {{0, 1, 2, 3}, {}};
  const Overlay same = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  MatchOptions options;
  options.levels = {LevelNames(graph)[0]};
  MatchResult match;
  MatchPlaced({graph, labels}, {graph, labels}, same, options, match);
  EXPECT_EQ(match.best_query_level, 0);
}

TEST(MatchPlaced, ChangesNothingWhereNothingLiesOnAnything) {
  const ShapeGraph graph = GraphOf({2});
  const FaceLabels labels = {{0, -1}, {}};
  MatchResult match;
  match.pairs = {{1, 1, 0.5F}};
  // On nothing, on a dropped face, on a face that is not there.
  for (const Overlay& overlay :
       {Overlay{}, Overlay{{0, -1}}, Overlay{{0, 1}}, Overlay{{0, 7}}}) {
    MatchPlaced({graph, labels}, {graph, labels}, overlay, {}, match);
    EXPECT_THAT(match.pairs, ElementsAre(Pairs(1, 1)));
  }
}

}  // namespace
}  // namespace argmesh
