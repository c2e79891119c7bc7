#include "core/mesh/mesh_subdivide.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_inspect.h"
#include "core/mesh/mesh_weld.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

double LongestEdge(const TriangleMesh& mesh) {
  double longest = 0;
  for (const auto& [a, b] :
       ComputeMeshEdges(mesh.F, mesh.num_vertices()).ends) {
    longest = std::max(longest, (mesh.V.row(a) - mesh.V.row(b)).norm());
  }
  return longest;
}

TEST(SubdivideLongEdges, LeavesNoEdgeLongerThanTheBound) {
  for (const double bound : {1.3, 0.5, 0.2}) {
    SCOPED_TRACE(bound);
    TriangleMesh torus = MakeTorus(2, 0.5, 7, 5);
    const double area = Area(torus);
    ASSERT_TRUE(
        SubdivideLongEdges(
            {.max_edge_length = bound, .max_new_vertices = 100'000}, {}, torus)
            .ok());
    EXPECT_LE(LongestEdge(torus), bound);
    EXPECT_NEAR(Area(torus), area, 1e-12 * area);
    const MeshReport report = InspectMesh(torus, 0);
    EXPECT_EQ(report.euler_characteristic, 0);
    EXPECT_EQ(report.boundary_edges, 0);
    EXPECT_EQ(report.degenerate_faces_dropped, 0);
  }
}

TEST(SubdivideLongEdges, KeepsEveryFaceOnItsSide) {
  TriangleMesh sheet = MakeSheet(3);
  sheet.V.col(0) *= 5;
  ASSERT_TRUE(
      SubdivideLongEdges({.max_edge_length = 0.4, .max_new_vertices = 10'000},
                         {}, sheet)
          .ok());
  for (int f = 0; f < sheet.num_faces(); ++f) {
    EXPECT_GT(FaceCross(sheet, f).z(), 0);
  }
}

TEST(SubdivideLongEdges, TightensTheBoundUntilThereAreEnoughVertices) {
  TriangleMesh sheet = MakeSheet(1);
  ASSERT_TRUE(SubdivideLongEdges({.max_edge_length = 10,
                                  .min_vertices = 700,
                                  .max_new_vertices = 7000},
                                 {}, sheet)
                  .ok());
  EXPECT_GE(sheet.num_vertices(), 700);
  EXPECT_LE(sheet.num_vertices(), 7004);
}

TEST(SubdivideLongEdges, SplitsTheLongestFirstWhenRoomIsShort) {
  TriangleMesh pair = Join(MakeSheet(1), Translated(MakeSheet(1), {2, 0, 0}));
  pair.V.bottomRows(4) *= 100;
  const TriangleMesh before = pair;
  ASSERT_TRUE(SubdivideLongEdges(
                  {.max_edge_length = 0.1, .max_new_vertices = 3}, {}, pair)
                  .ok());
  EXPECT_EQ(pair.num_vertices(), 11);
  EXPECT_EQ(pair.F.topRows(2), before.F.topRows(2));  // the small sheet
}

}  // namespace
}  // namespace argmesh
