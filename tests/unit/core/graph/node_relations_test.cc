#include "core/graph/node_relations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/support/status_matchers.h"
#include "tests/unit/core/graph/sphere_surface.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;

TEST(AverageGeodesicDistances, AreTheClosedFormOfHemispheres) {
  const SurfaceAbstraction surface = MakeSphereSurface(5);
  const std::vector<int32_t> labels =
      surface.decomposition.ComponentOfSample(0);
  const NodeMembers members = CollectMembers(surface, labels, 2);
  GeodesicSolver solver(surface.geodesic_graph);
  ASSERT_OK_AND_ASSIGN(
      const Eigen::MatrixXd distances,
      AverageGeodesicDistances(members, labels, surface.features.areas, solver,
                               StopToken()));
  // Mean angle from a pole to the other hemisphere: pi - 1; to its own: 1.
  const double expected = kSphereRadius * (std::numbers::pi - 1);
  EXPECT_NEAR(distances(0, 1), expected, 0.05 * expected);
  EXPECT_EQ(distances(0, 1), distances(1, 0));
  EXPECT_NEAR(distances(0, 0), kSphereRadius, 0.05 * kSphereRadius);
}

TEST(AverageGeodesicDistances, StopWhenCancelled) {
  const SurfaceAbstraction surface = MakeSphereSurface(2);
  const std::vector<int32_t>& labels = surface.decomposition.region_of_sample;
  const NodeMembers members = CollectMembers(surface, labels, 8);
  GeodesicSolver solver(surface.geodesic_graph);
  std::stop_source source;
  source.request_stop();
  const auto distances = AverageGeodesicDistances(
      members, labels, surface.features.areas, solver,
      StopToken(source.get_token(), absl::InfiniteFuture()));
  EXPECT_EQ(distances.status().code(), absl::StatusCode::kCancelled);
}

TEST(GroupDistances, AreMeansOverPairsWeightedByArea) {
  Eigen::MatrixXd distances(3, 3);
  distances << 0, 9, 2, 9, 0, 4, 2, 4, 0;
  const std::vector<double> areas = {0.25, 0.5, 0.25};
  const std::vector<int32_t> groups = {0, 0, 1};
  const Eigen::MatrixXd grouped = GroupDistances(distances, areas, groups, 2);
  EXPECT_NEAR(grouped(0, 1), (0.25 * 2 + 0.5 * 4) / 0.75, 1e-12);
  EXPECT_EQ(grouped(0, 1), grouped(1, 0));
}

TEST(PackDistances, KeepsTheUpperTriangleRowAfterRow) {
  Eigen::MatrixXd distances(3, 3);
  distances << 0, 1, 2, 1, 0, 12, 2, 12, 0;
  EXPECT_THAT(PackDistances(distances), ElementsAre(1, 2, 12));
}

TEST(FindEdges, JoinsNodesAlongMeshEdgesAndAcrossBridges) {
  // Samples 0 - 1 by a mesh edge of length 3, 1 - 2 by a bridge, 0 - 2 by a
  // diagonal only.
  SurfaceGraph graph;
  graph.offsets = {0, 2, 4, 6};
  graph.targets = {1, 2, 0, 2, 0, 1};
  graph.lengths = {3, 1, 3, 2, 1, 2};
  graph.kinds = {LinkKind::kEdge,   LinkKind::kDiagonal, LinkKind::kEdge,
                 LinkKind::kBridge, LinkKind::kDiagonal, LinkKind::kBridge};
  Eigen::MatrixXd distances(3, 3);
  distances << 0, 1, 2, 1, 0, 12, 2, 12, 0;
  const std::vector<int32_t> labels = {0, 1, 2};
  EXPECT_THAT(FindEdges(graph, labels, distances),
              ElementsAre(ArgEdge{0, 1, 1, 1.5F}, ArgEdge{1, 2, 12, 0}));
}

TEST(FindEdges, MeasuresTheEquator) {
  const SurfaceAbstraction surface = MakeSphereSurface(5);
  const std::vector<ArgEdge> edges =
      FindEdges(surface.edge_graph, surface.decomposition.ComponentOfSample(0),
                Eigen::MatrixXd::Ones(2, 2));
  ASSERT_EQ(edges.size(), 1u);
  // Half the edges across a border: its length up to the pattern of the mesh.
  const double equator = 2 * std::numbers::pi * kSphereRadius;
  EXPECT_GT(edges[0].border_length, 0.7 * equator);
  EXPECT_LT(edges[0].border_length, 1.3 * equator);
}

}  // namespace
}  // namespace argmesh
