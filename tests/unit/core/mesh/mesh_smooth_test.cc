#include "core/mesh/mesh_smooth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/mesh/mesh_weld.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

TEST(SmoothTaubin, KeepsTheBoundaryInPlace) {
  TriangleMesh sheet = MakeSheet(8);
  Random random(1);
  for (int v = 0; v < sheet.num_vertices(); ++v) {
    sheet.V(v, 2) = 0.05 * random.Normal();
  }
  const TriangleMesh before = sheet;
  SmoothTaubin(sheet);
  int moved = 0;
  for (int v = 0; v < sheet.num_vertices(); ++v) {
    const double x = before.V(v, 0);
    const double y = before.V(v, 1);
    if (before.V.row(v) != sheet.V.row(v)) {
      ++moved;
      EXPECT_TRUE(x > 0 && x < 1 && y > 0 && y < 1) << v;
    }
  }
  EXPECT_EQ(moved, 49);
}

TEST(SmoothTaubin, TakesOneStepAsWrittenDown) {
  // A fan of four around vertex 0, the only interior one.
  TriangleMesh fan;
  fan.V.resize(5, 3);
  fan.V << 0.2, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0;
  fan.F.resize(4, 3);
  fan.F << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1;
  SmoothTaubin(fan, {.steps = 1, .lambda = 0.5, .mu = -0.6});
  // The mean of the neighbours is the origin.
  EXPECT_NEAR(fan.V(0, 0), 0.2 * 0.5 * 1.6, 1e-15);
  EXPECT_NEAR(fan.V(0, 2), 1 * 0.5 * 1.6, 1e-15);
}

TEST(SmoothTaubin, RemovesNoiseWithoutShrinking) {
  const TriangleMesh clean = MakeTorus(2, 0.7, 96, 48);
  TriangleMesh noisy = clean;
  Random random(7);
  for (Eigen::Index v = 0; v < noisy.V.rows(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      noisy.V(v, axis) += 0.02 * random.Normal();
    }
  }
  const double noisy_area = Area(noisy);
  TriangleMesh smooth = noisy;
  SmoothTaubin(smooth);
  EXPECT_GT(noisy_area, 1.05 * Area(clean));
  EXPECT_NEAR(Area(smooth) / Area(clean), 1, 0.02);
  EXPECT_LT((smooth.V - clean.V).norm(), 0.6 * (noisy.V - clean.V).norm());
}

TEST(SmoothTaubin, DoesNothingInNoSteps) {
  TriangleMesh torus = MakeTorus(2, 1, 8, 8);
  SmoothTaubin(torus, {.steps = 0});
  EXPECT_EQ(torus.V, MakeTorus(2, 1, 8, 8).V);
}

TEST(NormalizeToUnitArea, CentresAndScalesAMeshFarAway) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    TriangleMesh mesh =
        Translated(RandomlyMoved(MakeDumbbell(16), seed), {1e5, -3e5, 2e5});
    const TriangleMesh before = mesh;
    const UnitAreaTransform transform = NormalizeToUnitArea(mesh);
    EXPECT_NEAR(Area(mesh), 1, 1e-9);
    TriangleMesh again = mesh;
    EXPECT_LT(NormalizeToUnitArea(again).centroid.norm(), 1e-9);
    const Eigen::Vector3d mapped =
        (before.vertex(3) - transform.centroid) * transform.scale;
    EXPECT_NEAR((mapped - mesh.vertex(3)).norm(), 0, 1e-9);
  }
}

TEST(NormalizeToUnitArea, FindsTheCentroidOfASheet) {
  TriangleMesh sheet = MakeSheet(3);
  sheet.V *= 2;
  const UnitAreaTransform transform = NormalizeToUnitArea(sheet);
  EXPECT_NEAR((transform.centroid - Eigen::Vector3d(1, 1, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR(transform.scale, 0.5, 1e-14);
}

}  // namespace
}  // namespace argmesh
