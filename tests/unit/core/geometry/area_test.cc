#include "core/geometry/area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "tests/unit/core/geometry/closed_form_meshes.h"

namespace argmesh {
namespace {

TEST(ComputeFaceAreas, SumToTheAreaOfASphere) {
  const double area = ComputeFaceAreas(MakeIrregularSphere(20, 2, 1)).sum();
  EXPECT_NEAR(area, 16 * std::numbers::pi, 0.01 * 16 * std::numbers::pi);
  EXPECT_LT(area, 16 * std::numbers::pi);  // an inscribed polyhedron
}

TEST(ComputeFaceAreas, SumToTheAreaOfATorus) {
  EXPECT_NEAR(ComputeFaceAreas(MakeTorus(2, 0.5, 120, 60)).sum(),
              4 * std::numbers::pi * std::numbers::pi,
              0.005 * 4 * std::numbers::pi * std::numbers::pi);
}

TEST(ComputeFaceAreas, SumToTheAreaOfACylinder) {
  EXPECT_NEAR(ComputeFaceAreas(MakeOpenCylinder(1.5, 4, 100, 5, false)).sum(),
              2 * std::numbers::pi * 1.5 * 4, 0.002 * 12 * std::numbers::pi);
}

TEST(ComputeFaceAreas, AreZeroForADegenerateFace) {
  TriangleMesh mesh;
  mesh.V.resize(3, 3);
  mesh.V << 0, 0, 0, 1, 1, 1, 2, 2, 2;
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  EXPECT_EQ(ComputeFaceAreas(mesh)[0], 0);
  EXPECT_EQ(ComputeVertexAreas(mesh).sum(), 0);
  EXPECT_EQ(ComputeVertexNormals(mesh).norm(), 0);
}

TEST(ComputeVertexAreas, SumToTheSurfaceForAnyTriangles) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    TriangleMesh mesh = MakeGrid(1, 12, seed);
    // Shaken until many triangles are obtuse.
    for (Eigen::Index i = 0; i < mesh.V.size(); ++i) {
      mesh.V.data()[i] += random.Uniform(-0.06, 0.06);
    }
    const Eigen::VectorXd areas = ComputeVertexAreas(mesh);
    const double total = ComputeFaceAreas(mesh).sum();
    EXPECT_NEAR(areas.sum(), total, 1e-9 * total);
    EXPECT_GT(areas.minCoeff(), 0);
  }
}

TEST(ComputeVertexAreas, GivesTheObtuseCornerHalf) {
  TriangleMesh mesh;
  mesh.V.resize(3, 3);
  mesh.V << 0, 0, 0, 4, 0, 0, 2, 0.5, 0;
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  const Eigen::VectorXd areas = ComputeVertexAreas(mesh);
  EXPECT_NEAR(areas[0], 0.25, 1e-12);
  EXPECT_NEAR(areas[1], 0.25, 1e-12);
  EXPECT_NEAR(areas[2], 0.5, 1e-12);
}

TEST(ComputeVertexAreas, AreVoronoiCellsOfAnEquilateralTriangle) {
  TriangleMesh mesh;
  mesh.V.resize(3, 3);
  mesh.V << 0, 0, 0, 1, 0, 0, 0.5, std::sqrt(3) / 2, 0;
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  for (const double area : ComputeVertexAreas(mesh)) {
    EXPECT_NEAR(area, std::sqrt(3) / 12, 1e-12);
  }
}

TEST(ComputeVertexNormals, PointOutwardsOnASphere) {
  const TriangleMesh mesh = MakeIrregularSphere(12, 3, 2);
  const VertexMatrix normals = ComputeVertexNormals(mesh);
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    EXPECT_NEAR(normals.row(v).norm(), 1, 1e-12);
    EXPECT_GT(normals.row(v).dot(mesh.V.row(v)) / 3, 0.99);
  }
}

TEST(ComputeVertexNormals, TurnWithTheMesh) {
  const TriangleMesh mesh = MakeIrregularSphere(6, 1, 3);
  const Eigen::Matrix3d rotation = RandomRotation(3);
  const VertexMatrix turned =
      ComputeVertexNormals(Moved(mesh, rotation, 7, {5, -2, 1}));
  EXPECT_LT((turned - ComputeVertexNormals(mesh) * rotation.transpose()).norm(),
            1e-10);
}

}  // namespace
}  // namespace argmesh
