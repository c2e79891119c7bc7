#include "core/graph/node_attributes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include "tests/unit/core/graph/sphere_surface.h"

namespace argmesh {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatNear;

class HemisphereTest : public ::testing::Test {
 protected:
  HemisphereTest()
      : surface_(MakeSphereSurface(5)),
        labels_(surface_.decomposition.ComponentOfSample(0)),
        members_(CollectMembers(surface_, labels_, 2)) {
    GeodesicSolver solver(surface_.geodesic_graph);
    nodes_ = ComputeNodeAttributes(surface_, SampleTerms(surface_), members_,
                                   labels_, solver);
  }

  SurfaceAbstraction surface_;
  std::vector<int32_t> labels_;
  NodeMembers members_;
  std::vector<ArgNode> nodes_;
};

TEST_F(HemisphereTest, HasItsPoleAsCenterSample) {
  EXPECT_EQ(members_.center_sample[0], 4);
  EXPECT_EQ(members_.center_sample[1], 5);
  EXPECT_NEAR(members_.center[0].z(), kSphereRadius / 2, 0.005);
  // The samples of the equator belong to the upper one.
  EXPECT_NEAR(members_.area[0], 0.5, 0.015);
  EXPECT_NEAR(members_.area[0] + members_.area[1], 1, 1e-12);
}

TEST_F(HemisphereTest, HasTheClosedFormTuple) {
  const NodeTuple& tuple = nodes_[0].tuple;
  const double area = members_.area[0];
  // The mean normal of a hemisphere is half a unit vector.
  EXPECT_NEAR(tuple.normal_deviation, std::sqrt(0.75), 0.01);
  EXPECT_NEAR(tuple.gauss_mean, std::asinh(area * 4 * std::numbers::pi), 1e-5);
  EXPECT_NEAR(tuple.mean_mean, std::asinh(std::sqrt(area) / kSphereRadius),
              1e-5);
  EXPECT_NEAR(tuple.gauss_deviation, 0, 1e-4);
  EXPECT_NEAR(tuple.mean_deviation, 0, 1e-4);
  EXPECT_NEAR(tuple.log2_relative_area, std::log2(area), 1e-5);
  // Mean angle from the pole is 1, its standard deviation sqrt(pi - 3).
  const double unit = kSphereRadius / std::sqrt(0.5);
  EXPECT_NEAR(tuple.geodesic_mean, unit, 0.05 * unit);
  EXPECT_NEAR(tuple.geodesic_deviation, unit * std::sqrt(std::numbers::pi - 3),
              0.05 * unit);
}

TEST_F(HemisphereTest, HasHistogramsOfItsConstantFeatures) {
  const NodeHistograms& histograms = nodes_[1].histograms;
  // Shape index 1: the last of nine bins.
  EXPECT_THAT(histograms.shape_index,
              ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, FloatNear(1, 1e-5F)));
  // (log2 0.5 + 7) / 7 = 6/7 of ten bins: between bins 8 and 9.
  EXPECT_NEAR(histograms.shape_diameter[8], 1 - (60.0 / 7 - 0.5 - 8), 1e-5);
  EXPECT_NEAR(histograms.shape_diameter[8] + histograms.shape_diameter[9], 1,
              1e-5);
  EXPECT_THAT(nodes_[1].wave_kernel, Each(FloatNear(0, 1e-6F)));
}

TEST_F(HemisphereTest, HasHistogramsThatSumToOne) {
  for (const ArgNode& node : nodes_) {
    const NodeHistograms& h = node.histograms;
    const auto sum = [](const auto& bins) {
      return std::accumulate(bins.begin(), bins.end(), 0.0);
    };
    EXPECT_NEAR(sum(h.average_geodesic), 1, 1e-5);
    EXPECT_NEAR(sum(h.curvedness), 1, 1e-5);
    EXPECT_NEAR(sum(h.internal_distance), 1, 1e-5);
    EXPECT_NEAR(sum(h.outer_distance), 1, 1e-5);
    EXPECT_NEAR(sum(h.relative_diameter), 1, 1e-5);
  }
}

TEST(ComputeNodeAttributes, StaysFiniteWithoutAnyArea) {
  SurfaceAbstraction surface = MakeSphereSurface(2);
  // The pole alone is a node, and has no area.
  std::vector<int32_t> labels(surface.decomposition.region_of_sample.size());
  labels[4] = 1;
  surface.features.areas[4] = 0;
  const NodeMembers members = CollectMembers(surface, labels, 2);
  GeodesicSolver solver(surface.geodesic_graph);
  ShapeGraph graph;
  graph.levels.resize(1);
  graph.levels[0].nodes = ComputeNodeAttributes(surface, SampleTerms(surface),
                                                members, labels, solver);
  graph.levels[0].distances = {0};
  EXPECT_TRUE(CheckShapeGraph(graph).ok()) << CheckShapeGraph(graph);
  EXPECT_GT(graph.levels[0].nodes[1].area, 0);
}

TEST(StratifiedSamples, TakeEachShareOfTheAreaOnce) {
  const std::vector<int32_t> samples = {3, 1, 0, 2};
  Eigen::VectorXd areas(4);
  areas << 1, 1, 1, 4;  // sample 3 holds 4 of 7
  EXPECT_THAT(StratifiedSamples(samples, areas, 4), ElementsAre(3, 3, 1, 2));
  EXPECT_THAT(StratifiedSamples(samples, areas, 2), ElementsAre(3, 0));
  EXPECT_THAT(StratifiedSamples(samples, areas, 99).size(), 4);
}

}  // namespace
}  // namespace argmesh
