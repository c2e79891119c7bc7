#include "core/mesh/mesh_inspect.h"

#include <gtest/gtest.h>

#include "core/mesh/mesh_repair.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

TEST(InspectMesh, FindsTheGenusAndBoxOfATorus) {
  const MeshReport report = InspectMesh(MakeTorus(2, 0.5, 32, 16));
  EXPECT_EQ(report.euler_characteristic, 0);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.boundary_edges, 0);
  EXPECT_EQ(report.nonmanifold_edges, 0);
  EXPECT_EQ(report.nonmanifold_vertices, 0);
  EXPECT_NEAR(report.bounding_box_min[0], -2.5, 1e-12);
  EXPECT_NEAR(report.bounding_box_max[2], 0.5, 1e-12);
}

TEST(InspectMesh, CountsTheBoundaryOfASheet) {
  const MeshReport report = InspectMesh(MakeSheet(7));
  EXPECT_EQ(report.vertices, 64);
  EXPECT_EQ(report.faces, 98);
  EXPECT_EQ(report.boundary_edges, 28);
  EXPECT_EQ(report.euler_characteristic, 1);
  EXPECT_NEAR(report.area, 1, 1e-12);
}

TEST(InspectMesh, CountsComponentsApart) {
  const TriangleMesh pair =
      Join(MakeSheet(3), Translated(MakeSheet(3), {0, 0, 1}));
  EXPECT_EQ(InspectMesh(pair).components, 2);
}

TEST(InspectMesh, CountsThreeSheetsAtOneEdge) {
  TriangleMesh fan;
  fan.V.resize(5, 3);
  fan.V << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0;
  fan.F.resize(3, 3);
  fan.F << 0, 1, 2, 0, 1, 3, 0, 1, 4;
  const MeshReport report = InspectMesh(fan);
  EXPECT_EQ(report.nonmanifold_edges, 1);
  EXPECT_EQ(report.nonmanifold_vertices, 2);
  EXPECT_EQ(report.boundary_edges, 6);
  EXPECT_EQ(report.components, 1);
}

TEST(InspectMesh, FindsTheSameAsARepair) {
  const TriangleMesh mesh = Join(MakeDumbbell(16), MakeTorus(3, 1, 12, 8));
  const MeshReport found = InspectMesh(mesh);
  ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(mesh));
  EXPECT_EQ(found.components, repaired.report.components);
  EXPECT_EQ(found.euler_characteristic, repaired.report.euler_characteristic);
  EXPECT_EQ(found.euler_characteristic, 2);
  EXPECT_EQ(found.area, repaired.report.area);
}

TEST(InspectMesh, ReportsAMeshWithoutFaces) {
  TriangleMesh points;
  points.V = VertexMatrix::Zero(3, 3);
  const MeshReport report = InspectMesh(points);
  EXPECT_EQ(report.vertices, 3);
  EXPECT_EQ(report.unused_vertices, 3);
  EXPECT_EQ(report.components, 0);
  EXPECT_EQ(report.area, 0);
}

}  // namespace
}  // namespace argmesh
