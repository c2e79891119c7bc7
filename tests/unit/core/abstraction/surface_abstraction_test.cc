#include "core/abstraction/surface_abstraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

AbstractionOptions SmallOptions(
    DecompositionKind kind = DecompositionKind::kBiharmonic) {
  AbstractionOptions options;
  options.resample.vertex_budget = 800;
  options.decomposition = DecompositionOptionsFor(kind);
  options.decomposition.biharmonic.super_samples = 200;
  return options;
}

// Area of the samples of each component at a level.
std::vector<double> ComponentAreas(const SurfaceAbstraction& surface,
                                   int level) {
  const std::vector<int32_t> component =
      surface.decomposition.ComponentOfSample(level);
  std::vector<double> areas(static_cast<size_t>(
      surface.decomposition.levels[static_cast<size_t>(level)].num_components));
  for (size_t v = 0; v < component.size(); ++v) {
    areas[static_cast<size_t>(component[v])] +=
        surface.features.areas[static_cast<Eigen::Index>(v)];
  }
  return areas;
}

TEST(AbstractSurface, CutsADumbbellIntoItsBalls) {
  ASSERT_OK_AND_ASSIGN(const SurfaceAbstraction surface,
                       AbstractSurface(MakeDumbbell(), SmallOptions()));
  // At some threshold level the two balls are two components of equal area
  // that hold nearly everything.
  bool found = false;
  for (int level = 0; level < 4; ++level) {
    std::vector<double> areas = ComponentAreas(surface, level);
    std::sort(areas.rbegin(), areas.rend());
    if (areas.size() >= 2 && areas[1] > 0.4 && areas[0] < 0.55) found = true;
  }
  EXPECT_TRUE(found);
}

class AbstractSurfaceEveryKind
    : public ::testing::TestWithParam<DecompositionKind> {};

TEST_P(AbstractSurfaceEveryKind, NestsItsLevelsAndCoversTheSurface) {
  ASSERT_OK_AND_ASSIGN(
      const SurfaceAbstraction surface,
      AbstractSurface(MakeDumbbell(), SmallOptions(GetParam())));
  const Decomposition& decomposition = surface.decomposition;
  ASSERT_FALSE(decomposition.levels.empty());
  for (size_t l = 0; l < decomposition.levels.size(); ++l) {
    const DecompositionLevel& level = decomposition.levels[l];
    const std::vector<int32_t> component =
        decomposition.ComponentOfSample(static_cast<int>(l));
    const std::set<int32_t> used(component.begin(), component.end());
    EXPECT_EQ(used.size(), static_cast<size_t>(level.num_components));
    EXPECT_EQ(*used.begin(), 0);
    EXPECT_EQ(level.parent.size(), used.size());
    if (l == 0) continue;
    const std::vector<int32_t> before =
        decomposition.ComponentOfSample(static_cast<int>(l) - 1);
    for (size_t v = 0; v < component.size(); ++v) {
      EXPECT_EQ(level.parent[static_cast<size_t>(component[v])], before[v]);
    }
  }
  for (const Mode& mode : decomposition.modes) {
    EXPECT_GE(mode.repeatability, 1);
    EXPECT_GT(mode.window, 0);
    EXPECT_EQ(mode.region,
              decomposition.region_of_sample[static_cast<size_t>(mode.sample)]);
  }
}

TEST_P(AbstractSurfaceEveryKind, RepeatsToTheBit) {
  const TriangleMesh mesh = MakeTorus(1, 0.4, 60, 30);
  ASSERT_OK_AND_ASSIGN(const SurfaceAbstraction a,
                       AbstractSurface(mesh, SmallOptions(GetParam())));
  ASSERT_OK_AND_ASSIGN(const SurfaceAbstraction b,
                       AbstractSurface(mesh, SmallOptions(GetParam())));
  EXPECT_EQ(a.decomposition.region_of_sample, b.decomposition.region_of_sample);
  EXPECT_EQ(a.features.shape_diameter, b.features.shape_diameter);
  EXPECT_EQ(a.sample_of_face, b.sample_of_face);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AbstractSurfaceEveryKind,
                         ::testing::Values(DecompositionKind::kBiharmonic,
                                           DecompositionKind::kNormalCurvature,
                                           DecompositionKind::kVoronoi),
                         [](const auto& kind_info) {
                           std::string name(DecompositionName(kind_info.param));
                           std::erase(name, '-');
                           return name;
                         });

TEST(AbstractSurface, GivesEveryUsableFaceASample) {
  TriangleMesh mesh = MakeTorus(1, 0.4, 40, 20);
  mesh.F.row(7) << 3, 3, 5;  // degenerate
  ASSERT_OK_AND_ASSIGN(const SurfaceAbstraction surface,
                       AbstractSurface(mesh, SmallOptions()));
  ASSERT_EQ(surface.sample_of_face.size(),
            static_cast<size_t>(mesh.num_faces()));
  for (size_t f = 0; f < surface.sample_of_face.size(); ++f) {
    if (f == 7) {
      EXPECT_EQ(surface.sample_of_face[f], -1);
    } else {
      EXPECT_GE(surface.sample_of_face[f], 0);
      EXPECT_LT(surface.sample_of_face[f], surface.samples.num_vertices());
    }
  }
  EXPECT_EQ(surface.report.degenerate_faces_dropped, 1);
}

TEST(AbstractSurface, TakesOpenSheetsAndSeveralComponents) {
  EXPECT_THAT(AbstractSurface(MakeSheet(20), SmallOptions()), IsOk());
  const TriangleMesh two =
      Join(MakeTorus(1, 0.4, 40, 20),
           Translated(MakeTorus(1, 0.4, 40, 20), {5, 0, 0}));
  ASSERT_OK_AND_ASSIGN(const SurfaceAbstraction surface,
                       AbstractSurface(two, SmallOptions()));
  EXPECT_EQ(surface.edge_graph.num_components, 2);
  EXPECT_EQ(surface.report.components, 2);
}

TEST(AbstractSurface, TakesASingleTriangle) {
  TriangleMesh mesh;
  mesh.V = VertexMatrix::Identity(3, 3);
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  EXPECT_THAT(AbstractSurface(mesh, SmallOptions()), IsOk());
}

TEST(AbstractSurface, RefusesAMeshWithoutArea) {
  TriangleMesh mesh;
  mesh.V = VertexMatrix::Zero(3, 3);
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  EXPECT_THAT(
      AbstractSurface(mesh, SmallOptions()),
      StatusIs(absl::StatusCode::kFailedPrecondition, HasSubstr("area")));
}

TEST(AbstractSurface, KeepsLabelsGivenFromOutside) {
  const TriangleMesh mesh = MakeDumbbell();
  std::vector<int32_t> labels(static_cast<size_t>(mesh.num_faces()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    labels[static_cast<size_t>(f)] = mesh.V(mesh.F(f, 0), 2) < 0 ? 4 : 9;
  }
  AbstractionOptions options = SmallOptions(DecompositionKind::kGiven);
  options.given_labels = labels;
  ASSERT_OK_AND_ASSIGN(const SurfaceAbstraction surface,
                       AbstractSurface(mesh, options));
  EXPECT_EQ(surface.decomposition.num_regions, 2);
  options.given_labels = std::span(labels).first(3);
  EXPECT_THAT(AbstractSurface(mesh, options),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("3 given labels")));
}

TEST(AbstractSurface, NamesAnOptionOutsideItsRange) {
  AbstractionOptions options = SmallOptions();
  options.decomposition.max_regions = 0;
  EXPECT_THAT(AbstractSurface(MakeSheet(4), options),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("max_regions is 0")));
}

}  // namespace
}  // namespace argmesh
