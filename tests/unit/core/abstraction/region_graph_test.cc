#include "core/abstraction/region_graph.h"

#include <gtest/gtest.h>

namespace argmesh {
namespace {

// A path of n samples, links of length 1.
SurfaceGraph MakePath(int n) {
  SurfaceGraph graph;
  graph.offsets.push_back(0);
  for (int v = 0; v < n; ++v) {
    for (const int u : {v - 1, v + 1}) {
      if (u < 0 || u >= n) continue;
      graph.targets.push_back(u);
      graph.lengths.push_back(1);
      graph.kinds.push_back(LinkKind::kEdge);
    }
    graph.offsets.push_back(static_cast<int32_t>(graph.targets.size()));
  }
  return graph;
}

RegionGraph Build(const SurfaceGraph& graph, const std::vector<int32_t>& labels,
                  const RegionOptions& options,
                  std::vector<double> weights = {}) {
  if (weights.empty()) weights.assign(graph.targets.size(), 1.0);
  const auto n = static_cast<Eigen::Index>(labels.size());
  return BuildRegionGraph(
      graph, Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n)),
      weights, labels, options);
}

TEST(BuildRegionGraph, SeparatesPiecesOfOneLabelThatDoNotTouch) {
  RegionOptions options;
  options.min_area = 0;
  const RegionGraph regions = Build(MakePath(6), {7, 7, 7, 2, 7, 7}, options);
  EXPECT_EQ(regions.num_regions(), 3);
  EXPECT_EQ(regions.region_of_sample, (std::vector<int32_t>{0, 0, 0, 2, 1, 1}));
  EXPECT_DOUBLE_EQ(regions.areas[0], 0.5);
  EXPECT_DOUBLE_EQ(regions.borders(0, 2), 1);
  EXPECT_DOUBLE_EQ(regions.borders(0, 1), 0);
  EXPECT_EQ(regions.borders, regions.borders.transpose());
}

TEST(BuildRegionGraph, AbsorbsASmallRegionIntoItsStrongestNeighbour) {
  const SurfaceGraph graph = MakePath(9);
  std::vector<double> weights(graph.targets.size(), 1.0);
  // Samples 0-3, 4, 5-8: the border 4-5 is the stronger one.
  for (size_t link = 0; link < weights.size(); ++link) {
    const bool from4 = static_cast<int32_t>(link) >= graph.offsets[4] &&
                       static_cast<int32_t>(link) < graph.offsets[5];
    const bool from5 = static_cast<int32_t>(link) >= graph.offsets[5] &&
                       static_cast<int32_t>(link) < graph.offsets[6];
    if (from4 && graph.targets[link] == 5) weights[link] = 3;
    if (from5 && graph.targets[link] == 4) weights[link] = 3;
  }
  RegionOptions options;
  options.min_area = 0.2;
  const RegionGraph regions =
      Build(graph, {0, 0, 0, 0, 1, 2, 2, 2, 2}, options, weights);
  EXPECT_EQ(regions.num_regions(), 2);
  EXPECT_EQ(regions.region_of_sample,
            (std::vector<int32_t>{1, 1, 1, 1, 0, 0, 0, 0, 0}));
}

TEST(BuildRegionGraph, KeepsAtMostTheAskedNumberOfRegions) {
  RegionOptions options;
  options.min_area = 0;
  options.max_regions = 3;
  EXPECT_EQ(Build(MakePath(8), {0, 1, 2, 3, 4, 5, 6, 7}, options).num_regions(),
            3);
}

}  // namespace
}  // namespace argmesh
