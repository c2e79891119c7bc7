#include "core/mesh/mesh_collapse.h"

#include <gtest/gtest.h>

#include "core/mesh/mesh_inspect.h"
#include "core/mesh/mesh_weld.h"
#include "core/mesh/plane_quadric.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

TEST(PlaneQuadric, SumsWeightedSquaredDistances) {
  PlaneQuadric quadric;
  quadric.AddPlane({0, 0, 1}, {5, 5, 2}, 3);
  quadric.AddPlane({1, 0, 0}, {1, 7, 7}, 2);
  EXPECT_DOUBLE_EQ(quadric.weight(), 5);
  EXPECT_NEAR(quadric.SumAt({4, 0, 0}), 3 * 4 + 2 * 9, 1e-12);
  const Eigen::Vector3d lowest = quadric.Lowest({0, 0.5, 0}, 1e-9);
  EXPECT_NEAR((lowest - Eigen::Vector3d(1, 0.5, 2)).norm(), 0, 1e-6);
}

TEST(ComputeVertexQuadrics, SeeTheOutlineOfASheet) {
  const TriangleMesh sheet = MakeSheet(4);
  const auto quadrics = ComputeVertexQuadrics(
      sheet, ComputeMeshEdges(sheet.F, sheet.num_vertices()));
  // Vertex 2 lies on the lower side: two edges of length 1/4 stand upright.
  EXPECT_NEAR(quadrics[2].SumAt({0.5, 0.1, 0}), 2 * 0.0625 * 0.01, 1e-12);
  // Vertex 12 is the middle: only its plane counts, with the area 1/16.
  EXPECT_NEAR(quadrics[12].SumAt({0.9, 0.1, 0}), 0, 1e-12);
  EXPECT_NEAR(quadrics[12].SumAt({0.9, 0.1, 0.5}), 0.25 / 16, 1e-12);
}

TEST(CollapseEdges, StopsAtTheTarget) {
  const TriangleMesh torus = MakeTorus(2, 0.7, 40, 20);
  for (const int target : {799, 400, 50}) {
    SCOPED_TRACE(target);
    ASSERT_OK_AND_ASSIGN(const TriangleMesh mesh,
                         CollapseEdges(torus, {.target_vertices = target}, {}));
    EXPECT_EQ(mesh.num_vertices(), target);
    EXPECT_EQ(mesh.num_faces(), 2 * target);
    EXPECT_EQ(InspectMesh(mesh, 0).euler_characteristic, 0);
  }
}

TEST(CollapseEdges, ReturnsASmallMeshUnchanged) {
  const TriangleMesh torus = MakeTorus(2, 0.7, 10, 8);
  ASSERT_OK_AND_ASSIGN(const TriangleMesh mesh,
                       CollapseEdges(torus, {.target_vertices = 80}, {}));
  EXPECT_EQ(mesh.V, torus.V);
  EXPECT_EQ(mesh.num_faces(), torus.num_faces());
}

TEST(CollapseEdges, NeverChangesTopologyHoweverFewVerticesAreAskedFor) {
  ASSERT_OK_AND_ASSIGN(
      const TriangleMesh torus,
      CollapseEdges(MakeTorus(2, 0.7, 30, 16), {.target_vertices = 1}, {}));
  EXPECT_EQ(InspectMesh(torus, 0).euler_characteristic, 0);
  EXPECT_GE(torus.num_vertices(), 7);  // no torus has fewer
  ASSERT_OK_AND_ASSIGN(
      const TriangleMesh ball,
      CollapseEdges(MakeDumbbell(16), {.target_vertices = 1}, {}));
  EXPECT_EQ(InspectMesh(ball, 0).euler_characteristic, 2);
  EXPECT_LT(ball.num_vertices(), 60);
}

TEST(CollapseEdges, KeepsAFlatSheetFlatAndItsFacesUp) {
  ASSERT_OK_AND_ASSIGN(
      const TriangleMesh sheet,
      CollapseEdges(MakeSheet(20), {.target_vertices = 60}, {}));
  EXPECT_EQ(sheet.num_vertices(), 60);
  double area = 0;
  for (int f = 0; f < sheet.num_faces(); ++f) {
    EXPECT_GT(FaceCross(sheet, f).z(), 0);
    area += FaceCross(sheet, f).norm() / 2;
  }
  EXPECT_NEAR(area, 1, 0.02);
  EXPECT_LT(sheet.V.col(2).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace argmesh
