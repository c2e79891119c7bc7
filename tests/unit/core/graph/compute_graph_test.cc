#include "core/graph/compute_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "core/graph/graph_codec.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"
#include "tests/unit/core/graph/sphere_surface.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(BuildShapeGraph, HasTheLevelsOfTheDecompositionAndTheUniformCells) {
  ASSERT_OK_AND_ASSIGN(const ShapeGraph graph,
                       BuildShapeGraph(MakeSphereSurface(4), StopToken(),
                                       DecompositionKind::kGiven));
  EXPECT_THAT(CheckShapeGraph(graph), IsOk());
  EXPECT_THAT(LevelNames(graph),
              ElementsAre("ncut-1.6", "count-16", "uniform"));
  ASSERT_EQ(graph.levels[0].num_nodes(), 2);
  ASSERT_EQ(graph.levels[1].num_nodes(), 8);
  ASSERT_EQ(graph.uniform.num_nodes(), 4);
  EXPECT_EQ(graph.levels[0].nodes[1].parent, -1);
  EXPECT_EQ(graph.levels[1].nodes[5].parent, 1);
  EXPECT_EQ(graph.num_components, 1);
  EXPECT_EQ(graph.decomposition, 3u);
  EXPECT_EQ(graph.scale, 0.5);
  EXPECT_THAT(graph.centroid, ElementsAre(1, 2, 3));
}

TEST(BuildShapeGraph, GivesUniformCellsTheComponentWithMostOfTheirArea) {
  ASSERT_OK_AND_ASSIGN(const ShapeGraph graph,
                       BuildShapeGraph(MakeSphereSurface(4)));
  // The samples of the equator belong to the upper octants.
  for (int32_t c = 0; c < 4; ++c) {
    EXPECT_EQ(graph.uniform.nodes[static_cast<size_t>(c)].parent, c);
  }
}

TEST(BuildShapeGraph, FindsNeighboursAndOpposites) {
  ASSERT_OK_AND_ASSIGN(const ShapeGraph graph,
                       BuildShapeGraph(MakeSphereSurface(4)));
  const ArgLevel& octants = graph.levels[1];
  // Octants share borders where they differ in one sign.
  int long_borders = 0;
  for (const ArgEdge& edge : octants.edges) {
    const int differing = __builtin_popcount(static_cast<unsigned>(edge.a) ^
                                             static_cast<unsigned>(edge.b));
    if (differing == 1) {
      EXPECT_GT(edge.border_length, 0.2);
      ++long_borders;
    } else {
      EXPECT_LT(edge.border_length, 0.1);
    }
    EXPECT_EQ(edge.geodesic, octants.Distance(edge.a, edge.b));
  }
  EXPECT_EQ(long_borders, 12);
  EXPECT_GT(octants.Distance(0, 7), octants.Distance(0, 6));
  EXPECT_GT(octants.Distance(0, 6), octants.Distance(0, 4));
}

TEST(BuildShapeGraph, CopiesModes) {
  ASSERT_OK_AND_ASSIGN(const ShapeGraph graph,
                       BuildShapeGraph(MakeSphereSurface(3)));
  ASSERT_EQ(graph.modes.size(), 1u);
  const ArgMode& mode = graph.modes[0];
  EXPECT_THAT(mode.position,
              ElementsAre(0, 0, static_cast<float>(kSphereRadius)));
  EXPECT_EQ(mode.window, 0.05F);
  EXPECT_EQ(mode.repeatability, 3);
  EXPECT_EQ(mode.density, 0.5F);
  EXPECT_EQ(mode.offset, 0.1F);
  EXPECT_EQ(mode.node, 5);
}

TEST(BuildShapeGraph, IsTheSameEveryTime) {
  const SurfaceAbstraction surface = MakeSphereSurface(3);
  ASSERT_OK_AND_ASSIGN(const ShapeGraph first, BuildShapeGraph(surface));
  ASSERT_OK_AND_ASSIGN(const ShapeGraph second, BuildShapeGraph(surface));
  EXPECT_EQ(SerializeShapeGraph(first), SerializeShapeGraph(second));
}

TEST(BuildShapeGraph, WorksWithoutUniformCells) {
  SurfaceAbstraction surface = MakeSphereSurface(3);
  surface.num_uniform_cells = 0;
  surface.uniform_cell_of_sample.clear();
  ASSERT_OK_AND_ASSIGN(const ShapeGraph graph, BuildShapeGraph(surface));
  EXPECT_EQ(graph.uniform.num_nodes(), 0);
  EXPECT_TRUE(BuildFaceLabels(surface).uniform.empty());
}

TEST(BuildShapeGraph, RefusesFeaturesThatAreNotFinite) {
  SurfaceAbstraction surface = MakeSphereSurface(2);
  surface.features.mean_curvature[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(BuildShapeGraph(surface),
              StatusIs(absl::StatusCode::kInternal, HasSubstr("not finite")));
}

TEST(BuildShapeGraph, RefusesLabelsThatDoNotFit) {
  SurfaceAbstraction surface = MakeSphereSurface(2);
  surface.decomposition.region_of_sample[0] = 8;
  EXPECT_THAT(BuildShapeGraph(surface),
              StatusIs(absl::StatusCode::kInternal,
                       HasSubstr("regions: label 8 of 8")));
  surface = MakeSphereSurface(2);
  surface.num_uniform_cells = 5;
  EXPECT_THAT(BuildShapeGraph(surface),
              StatusIs(absl::StatusCode::kInternal,
                       HasSubstr("uniform cells: 4 has no sample")));
  surface = MakeSphereSurface(2);
  surface.features.areas.conservativeResize(3);
  EXPECT_THAT(BuildShapeGraph(surface),
              StatusIs(absl::StatusCode::kInternal, HasSubstr("do not fit")));
}

TEST(BuildFaceLabels, FollowsTheSampleOfEachFace) {
  const FaceLabels labels = BuildFaceLabels(MakeSphereSurface(3));
  // Sample 4, the upper pole, is in octant 0; sample 5 in octant 4.
  EXPECT_THAT(labels.component, ElementsAre(0, -1, 4, 0, 0));
  EXPECT_THAT(labels.uniform, ElementsAre(0, -1, 0, 0, 0));
}

// Two balls of different size on a bent neck, regular as parametric meshes
// are: equal costs and distances everywhere.
TriangleMesh MakeUnevenDumbbell() {
  TriangleMesh mesh = MakeDumbbell(24);
  for (Eigen::Index v = 0; v < mesh.V.rows(); ++v) {
    const double z = mesh.V(v, 2);
    mesh.V.row(v).head(2) *= 1 + 0.1 * z;
    mesh.V(v, 0) += 0.1 * z * z;
    mesh.V(v, 1) *= 0.9;
  }
  return mesh;
}

TEST(ComputeShapeGraph, SeesNoMotionScaleOrNumbering) {
  AbstractionOptions options;
  options.resample.vertex_budget = 600;
  const TriangleMesh mesh = MakeUnevenDumbbell();
  ASSERT_OK_AND_ASSIGN(const ComputedGraph original,
                       ComputeShapeGraph(mesh, options));
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    ASSERT_OK_AND_ASSIGN(const ComputedGraph moved,
                         ComputeShapeGraph(RandomlyMoved(mesh, seed), options));
    ASSERT_EQ(LevelNames(moved.graph), LevelNames(original.graph));
    const auto expect_equal = [](const ArgLevel& a, const ArgLevel& b) {
      ASSERT_EQ(a.num_nodes(), b.num_nodes());
      for (size_t i = 0; i < a.nodes.size(); ++i) {
        EXPECT_NEAR(a.nodes[i].area, b.nodes[i].area, 1e-5);
        EXPECT_NEAR(a.nodes[i].tuple.mean_mean, b.nodes[i].tuple.mean_mean,
                    1e-4);
      }
      for (size_t i = 0; i < a.distances.size(); ++i) {
        EXPECT_NEAR(a.distances[i], b.distances[i], 1e-4);
      }
    };
    expect_equal(original.graph.uniform, moved.graph.uniform);
    for (size_t l = 0; l < original.graph.levels.size(); ++l) {
      expect_equal(original.graph.levels[l], moved.graph.levels[l]);
    }
  }
}

}  // namespace
}  // namespace argmesh
