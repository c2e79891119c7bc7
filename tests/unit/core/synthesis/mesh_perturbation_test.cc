#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.h"
#include "core/synthesis/mesh_cut.h"
#include "core/synthesis/mesh_decimate.h"
#include "core/synthesis/mesh_noise.h"
#include "core/synthesis/mesh_similarity.h"
#include "core/synthesis/pose.h"
#include "core/synthesis/sample_shape.h"
#include "core/synthesis/surface_polygons.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/core/synthesis/closed_surface.h"

namespace argmesh {
namespace {

using std::numbers::pi;

TriangleMesh MakeSphere() {
  ImplicitSurface surface;
  surface.Add(MakeEllipsoid(Pose::Identity(), {1, 1, 1}));
  return PolygonizeSurface(surface).value().mesh;
}

double Diagonal(const TriangleMesh& mesh) {
  return (mesh.V.colwise().maxCoeff() - mesh.V.colwise().minCoeff()).norm();
}

TEST(AddNoise, MovesVerticesAlongTheNormalByTheStatedDeviation) {
  const TriangleMesh sphere = MakeSphere();
  const TriangleMesh noisy = AddNoise(sphere, 0.005, 77);
  EXPECT_EQ(noisy.F, sphere.F);
  const double deviation = 0.005 * Diagonal(sphere);
  double sum = 0;
  double squares = 0;
  for (int v = 0; v < sphere.num_vertices(); ++v) {
    const Eigen::Vector3d move = noisy.vertex(v) - sphere.vertex(v);
    const double along = move.dot(sphere.vertex(v).normalized());
    EXPECT_NEAR(std::abs(along), move.norm(), 0.05 * move.norm() + 1e-12);
    sum += along;
    squares += along * along;
  }
  const double n = sphere.num_vertices();
  EXPECT_NEAR(sum / n, 0, 4 * deviation / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), deviation, 0.05 * deviation);
}

TEST(AddNoise, RepeatsForEqualSeedsAndDoesNothingAtShareZero) {
  const TriangleMesh sphere = MakeSphere();
  EXPECT_EQ(AddNoise(sphere, 0.01, 5).V, AddNoise(sphere, 0.01, 5).V);
  EXPECT_NE(AddNoise(sphere, 0.01, 5).V, AddNoise(sphere, 0.01, 6).V);
  EXPECT_EQ(AddNoise(sphere, 0, 5).V, sphere.V);
}

TEST(CutByPlane, KeepsOneSideAndItsArea) {
  const TriangleMesh sphere = MakeSphere();
  Random random(21);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal())
            .normalized();
    const double offset = random.Uniform(-0.9, 0.9);
    const TriangleMesh cap =
        CutByPlane(sphere, {.normal = 3 * direction, .offset = 3 * offset});
    EXPECT_GE((cap.V * direction).minCoeff(), offset - 1e-12);
    // Archimedes: a cap's area is 2 pi times its height.
    EXPECT_NEAR(SurfaceArea(cap), 2 * pi * (1 - offset), 0.02) << "cut " << i;
    const TriangleMesh rest =
        CutByPlane(sphere, {.normal = -direction, .offset = -offset});
    EXPECT_NEAR(SurfaceArea(cap) + SurfaceArea(rest), SurfaceArea(sphere),
                1e-9);
    EXPECT_EQ(CountSurface(cap).components, 1);
    EXPECT_EQ(CountSurface(cap).euler, 1);  // a disc
  }
}

TEST(CutByPlane, KeepsAllOrNothingBeyondTheShape) {
  const TriangleMesh sphere = MakeSphere();
  EXPECT_EQ(CutByPlane(sphere, {.offset = -2}).F, sphere.F);
  EXPECT_EQ(CutByPlane(sphere, {.offset = 2}).num_faces(), 0);
  EXPECT_EQ(CutByPlane(sphere, {.offset = 2}).num_vertices(), 0);
}

TEST(CutHalf, CutsInTheMiddleOfTheAxis) {
  const TriangleMesh sphere = MakeSphere();
  for (int axis = 0; axis < 3; ++axis) {
    const TriangleMesh half = CutHalf(sphere, axis);
    EXPECT_NEAR(SurfaceArea(half), 2 * pi, 0.02);
    EXPECT_NEAR(half.V.col(axis).minCoeff(), 0, 0.01);
  }
}

TEST(DecimateMesh, MeetsTheTargetAndKeepsTopologyAndArea) {
  for (const char* name : {"mug", "octopus", "glasses"}) {
    ASSERT_OK_AND_ASSIGN(const SampleShape shape, MakeSampleShape(name, 2));
    const TriangleMesh coarse = DecimateMesh(shape.mesh, 1200);
    const SurfaceCounts counts = CountSurface(coarse);
    EXPECT_EQ(coarse.num_vertices(), 1200) << name;
    EXPECT_EQ(counts.unpaired_halfedges, 0) << name;
    EXPECT_EQ(counts.broken_fans, 0) << name;
    EXPECT_EQ(counts.euler, 2 - 2 * shape.genus) << name;
    EXPECT_NEAR(SurfaceArea(coarse) / SurfaceArea(shape.mesh), 1, 0.02) << name;
  }
}

TEST(DecimateMesh, KeepsTheBoundaryOfAnOpenSurface) {
  const TriangleMesh half = CutHalf(MakeSphere(), 2);
  const TriangleMesh coarse = DecimateMesh(half, 600);
  EXPECT_LT(coarse.num_vertices(), half.num_vertices() / 2);
  EXPECT_EQ(CountSurface(coarse).euler, 1);
  EXPECT_EQ(CountSurface(coarse).unpaired_halfedges,
            CountSurface(half).unpaired_halfedges);
}

TEST(RandomSimilarity, PreservesTheShapeUpToScale) {
  const TriangleMesh sphere = CutHalf(MakeSphere(), 0);
  for (uint64_t seed = 0; seed < 5; ++seed) {
    const TriangleMesh moved =
        RandomSimilarity(sphere, seed, {.renumber = false});
    EXPECT_EQ(moved.F, sphere.F);
    const double scale = (moved.vertex(1) - moved.vertex(0)).norm() /
                         (sphere.vertex(1) - sphere.vertex(0)).norm();
    EXPECT_LE(std::abs(std::log(scale)), 2 + 1e-9);
    Random random(seed + 100);
    for (int i = 0; i < 100; ++i) {
      const auto n = static_cast<uint64_t>(sphere.num_vertices());
      const int a = static_cast<int>(random.Below(n));
      const int b = static_cast<int>(random.Below(n));
      EXPECT_NEAR((moved.vertex(a) - moved.vertex(b)).norm(),
                  scale * (sphere.vertex(a) - sphere.vertex(b)).norm(),
                  1e-9 * scale)
          << "seed " << seed;
    }
  }
}

TEST(RandomSimilarity, RenumbersAClosedSurfaceWithoutTurningItInsideOut) {
  ASSERT_OK_AND_ASSIGN(const SampleShape shape, MakeSampleShape("key", 3));
  const TriangleMesh moved =
      RandomSimilarity(shape.mesh, 8, {.max_log_scale = 0});
  EXPECT_NE(moved.F, shape.mesh.F);
  EXPECT_EQ(CountSurface(moved).unpaired_halfedges, 0);
  EXPECT_EQ(CountSurface(moved).euler, 2 - 2 * shape.genus);
  EXPECT_NEAR(SurfaceArea(moved), SurfaceArea(shape.mesh), 1e-9);
  EXPECT_NEAR(SignedVolume(moved), SignedVolume(shape.mesh), 1e-9);
}

TEST(RemoveFaces, LeavesOutAboutTheShare) {
  const TriangleMesh sphere = MakeSphere();
  const TriangleMesh rest = RemoveFaces(sphere, 0.3, 4);
  EXPECT_NEAR(rest.num_faces(), 0.7 * sphere.num_faces(),
              0.03 * sphere.num_faces());
  EXPECT_THAT(CheckMesh(rest), IsOk());
  EXPECT_EQ(RemoveFaces(sphere, 0, 4).F, sphere.F);
  EXPECT_EQ(RemoveFaces(sphere, 1, 4).num_vertices(), 0);
}

TEST(MakeSoup, SharesNoVertexAndMovesNoFace) {
  const TriangleMesh sphere = MakeSphere();
  const TriangleMesh soup = MakeSoup(sphere);
  EXPECT_EQ(soup.num_vertices(), 3 * sphere.num_faces());
  EXPECT_EQ(soup.num_faces(), sphere.num_faces());
  EXPECT_EQ(SurfaceArea(soup), SurfaceArea(sphere));
}

}  // namespace
}  // namespace argmesh
