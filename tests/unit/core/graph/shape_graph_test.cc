#include "core/graph/shape_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;

TEST(ArgLevel, FindsTheDistanceOfEveryPairInBothOrders) {
  ArgLevel level;
  level.nodes.resize(4);
  // (0,1) (0,2) (0,3) (1,2) (1,3) (2,3)
  level.distances = {1, 2, 3, 12, 13, 23};
  EXPECT_EQ(level.Distance(0, 1), 1);
  EXPECT_EQ(level.Distance(0, 3), 3);
  EXPECT_EQ(level.Distance(1, 2), 12);
  EXPECT_EQ(level.Distance(3, 1), 13);
  EXPECT_EQ(level.Distance(3, 2), 23);
  EXPECT_EQ(level.Distance(2, 2), 0);
}

TEST(LevelNames, TellThresholdsFromCountsAndEndWithUniform) {
  ShapeGraph graph;
  graph.levels.resize(3);
  graph.levels[0].threshold = 1.6;
  graph.levels[1].threshold = 2;
  graph.levels[2].count = 16;
  EXPECT_THAT(LevelNames(graph),
              ElementsAre("ncut-1.6", "ncut-2", "count-16", "uniform"));
  EXPECT_THAT(LevelNames(ShapeGraph()), ElementsAre("uniform"));
}

TEST(LabelsAtLevel, FollowsParentsAndKeepsDroppedFaces) {
  ShapeGraph graph;
  graph.levels.resize(3);
  graph.levels[0].nodes.resize(1);
  graph.levels[1].nodes.resize(2);
  graph.levels[1].nodes[0].parent = 0;
  graph.levels[1].nodes[1].parent = 0;
  graph.levels[2].nodes.resize(3);
  graph.levels[2].nodes[0].parent = 1;
  graph.levels[2].nodes[1].parent = 0;
  graph.levels[2].nodes[2].parent = 1;
  FaceLabels labels;
  labels.component = {0, 1, -1, 2};
  EXPECT_THAT(LabelsAtLevel(graph, labels, 2), ElementsAre(0, 1, -1, 2));
  EXPECT_THAT(LabelsAtLevel(graph, labels, 1), ElementsAre(1, 0, -1, 1));
  EXPECT_THAT(LabelsAtLevel(graph, labels, 0), ElementsAre(0, 0, -1, 0));
}

TEST(LabelsAtLevel, TurnsALabelBeyondTheNodesIntoNone) {
  const ShapeGraph graph = MakeRandomGraph(1);
  FaceLabels labels;
  labels.component = {9999};
  EXPECT_THAT(LabelsAtLevel(graph, labels, 0), ElementsAre(-1));
}

}  // namespace
}  // namespace argmesh
