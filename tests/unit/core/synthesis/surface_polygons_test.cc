#include "core/synthesis/surface_polygons.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/random.h"
#include "core/synthesis/pose.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/core/synthesis/closed_surface.h"

namespace argmesh {
namespace {

using std::numbers::pi;
using ::testing::HasSubstr;

TEST(PolygonizeSurface, MeetsTheAreaAndVolumeOfASphere) {
  ImplicitSurface surface;
  surface.Add(MakeEllipsoid(At(1, 2, 3), {0.7, 0.7, 0.7}));
  ASSERT_OK_AND_ASSIGN(const PolygonizedSurface sphere,
                       PolygonizeSurface(surface));
  EXPECT_NEAR(SurfaceArea(sphere.mesh), 4 * pi * 0.49, 0.01);
  EXPECT_NEAR(SignedVolume(sphere.mesh), 4.0 / 3 * pi * 0.343, 0.01);
  EXPECT_EQ(CountSurface(sphere.mesh).euler, 2);
  EXPECT_NEAR(sphere.mesh.num_vertices(), 4500, 0.25 * 4500);
}

TEST(PolygonizeSurface, KeepsTheHoleOfATorus) {
  ImplicitSurface surface;
  surface.Add(MakeTorus(TurnX(33), 1.0, 0.3));
  ASSERT_OK_AND_ASSIGN(const PolygonizedSurface torus,
                       PolygonizeSurface(surface, {.target_vertices = 2000}));
  EXPECT_EQ(CountSurface(torus.mesh).euler, 0);
  EXPECT_NEAR(SurfaceArea(torus.mesh), 4 * pi * pi * 0.3, 0.03 * 11.8);
}

// Parts thinner than a cell make every kind of ambiguous cell.
TEST(PolygonizeSurface, StaysManifoldWhereTheGridIsTooCoarse) {
  for (uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    ImplicitSurface surface;
    surface.Add(MakeEllipsoid(Pose::Identity(), {0.8, 0.8, 0.8}));
    for (int i = 0; i < 60; ++i) {
      Eigen::Vector3d a;
      Eigen::Vector3d b;
      for (int k = 0; k < 3; ++k) {
        a[k] = random.Uniform(-1, 1);
        b[k] = random.Uniform(-1, 1);
      }
      const Primitive rod = MakeCapsule(a, b, 0.04, 0.03);
      i % 2 == 0 ? surface.Add(rod) : surface.Cut(rod);
    }
    ASSERT_OK_AND_ASSIGN(const PolygonizedSurface mess,
                         PolygonizeSurface(surface, {.target_vertices = 1500}));
    const SurfaceCounts counts = CountSurface(mess.mesh);
    EXPECT_EQ(counts.unpaired_halfedges, 0) << "seed " << seed;
    EXPECT_EQ(counts.broken_fans, 0) << "seed " << seed;
  }
}

TEST(PolygonizeSurface, LabelsFacesWithTheNearestPart) {
  ImplicitSurface surface;
  surface.BeginPart("left");
  surface.Add(MakeEllipsoid(At(-1, 0, 0), {1, 1, 1}));
  surface.BeginPart("right");
  surface.Add(MakeEllipsoid(At(1, 0, 0), {1, 1, 1}), 0.2);
  ASSERT_OK_AND_ASSIGN(const PolygonizedSurface pair,
                       PolygonizeSurface(surface));
  ASSERT_EQ(pair.part_of_face.size(),
            static_cast<size_t>(pair.mesh.num_faces()));
  for (int f = 0; f < pair.mesh.num_faces(); ++f) {
    const double x =
        (pair.mesh.V(pair.mesh.F(f, 0), 0) + pair.mesh.V(pair.mesh.F(f, 1), 0) +
         pair.mesh.V(pair.mesh.F(f, 2), 0)) /
        3;
    EXPECT_EQ(pair.part_of_face[static_cast<size_t>(f)], x > 0 ? 1 : 0);
  }
}

TEST(PolygonizeSurface, RefusesOptionsOutsideTheirRangeAndEmptySurfaces) {
  ImplicitSurface surface;
  EXPECT_THAT(PolygonizeSurface(surface),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("no primitives")));
  surface.Add(MakeEllipsoid(Pose::Identity(), {1, 1, 1}));
  EXPECT_THAT(PolygonizeSurface(surface, {.target_vertices = 99}),
              StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("99")));
  EXPECT_THAT(PolygonizeSurface(surface, {.relax_rounds = 21}),
              StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("21")));
  surface.Cut(MakeBox(Pose::Identity(), {2, 2, 2}, 0));
  EXPECT_THAT(
      PolygonizeSurface(surface),
      StatusIs(absl::StatusCode::kFailedPrecondition, HasSubstr("empty")));
}

}  // namespace
}  // namespace argmesh
