#include "core/matching/spectral_matching.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

#include "core/matching/packed_graph.h"
#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

void ExpectOneToOne(const std::vector<NodePair>& pairs, int query_nodes,
                    int target_nodes) {
  std::set<int32_t> query, target;
  int32_t before = -1;
  for (const NodePair& pair : pairs) {
    EXPECT_GT(pair.query_node, before);
    before = pair.query_node;
    EXPECT_TRUE(query.insert(pair.query_node).second);
    EXPECT_TRUE(target.insert(pair.target_node).second);
    EXPECT_LT(pair.query_node, query_nodes);
    EXPECT_LT(pair.target_node, target_nodes);
    EXPECT_GE(pair.similarity, 0);
    EXPECT_LE(pair.similarity, 1);
  }
}

TEST(MatchSpectral, PairsEachNodeOnce) {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const int n = 1 + static_cast<int>(seed % 12);
    const int m = 1 + static_cast<int>(seed % 7);
    const MatchableGraph a(MakeRandomGraph(seed, {.level_nodes = {n}}));
    const MatchableGraph b(MakeRandomGraph(seed + 99, {.level_nodes = {m}}));
    const std::vector<NodePair> pairs =
        MatchSpectral(a.impl().levels[0], b.impl().levels[0], RowKind::kFull);
    ExpectOneToOne(pairs, n, m);
    EXPECT_FALSE(pairs.empty()) << seed;
  }
}

TEST(MatchSpectral, FindsTheNodesOfASlightlyChangedGraph) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const ShapeGraph graph = MakeRandomGraph(seed);
    const MatchableGraph a(graph), b(PerturbGraph(graph, 0.01F, seed));
    const std::vector<NodePair> pairs =
        MatchSpectral(a.impl().uniform, b.impl().uniform, RowKind::kFull);
    EXPECT_EQ(pairs.size(), 12u) << seed;
    for (const NodePair& pair : pairs) {
      EXPECT_EQ(pair.query_node, pair.target_node) << seed;
    }
  }
}

TEST(MatchSpectral, TellsTwinsApartByHowFarTheyLieFromTheOthers) {
  // Nodes 1 and 2 have equal attributes; node 0 lies near 1 and far from 2.
  ShapeGraph graph =
      MakeRandomGraph(3, {.level_nodes = {3}, .uniform_nodes = 0});
  ArgLevel& level = graph.levels[0];
  level.nodes[1] = level.nodes[2];
  level.distances = {0.2F, 1.0F, 0.9F};  // (0,1) (0,2) (1,2)
  ShapeGraph swapped = graph;
  swapped.levels[0].distances = {1.0F, 0.2F, 0.9F};
  const MatchableGraph a(graph), b(swapped);
  const std::vector<NodePair> pairs =
      MatchSpectral(a.impl().levels[0], b.impl().levels[0], RowKind::kFull);
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].target_node, 0);
  EXPECT_EQ(pairs[1].target_node, 2);
  EXPECT_EQ(pairs[2].target_node, 1);
}

TEST(MatchSpectral, IsTheSamePairingFromBothSides) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const MatchableGraph a(MakeRandomGraph(seed));
    const MatchableGraph b(MakeRandomGraph(seed + 50));
    const auto& x = a.impl().levels.back();
    const auto& y = b.impl().levels.back();
    std::set<std::pair<int32_t, int32_t>> forward, backward;
    for (const NodePair& p : MatchSpectral(x, y, RowKind::kFull)) {
      forward.emplace(p.query_node, p.target_node);
    }
    for (const NodePair& p : MatchSpectral(y, x, RowKind::kFull)) {
      backward.emplace(p.target_node, p.query_node);
    }
    EXPECT_EQ(forward, backward) << seed;
  }
}

}  // namespace
}  // namespace argmesh
