#include "core/mesh/triangle_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TriangleMesh MakeTwoTriangles() {
  TriangleMesh mesh;
  mesh.V.resize(5, 3);
  mesh.V << 0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  mesh.F.resize(2, 3);
  mesh.F << 0, 2, 3, 2, 4, 3;
  return mesh;
}

TEST(CheckMesh, AcceptsAProperMeshAndTheEmptyOne) {
  EXPECT_THAT(CheckMesh(MakeTwoTriangles()), IsOk());
  EXPECT_THAT(CheckMesh(TriangleMesh{}), IsOk());
}

TEST(CheckMesh, NamesTheFaceAndTheVertexBeyondTheEnd) {
  TriangleMesh mesh = MakeTwoTriangles();
  mesh.F(1, 2) = 5;
  EXPECT_THAT(CheckMesh(mesh), StatusIs(absl::StatusCode::kInvalidArgument,
                                        HasSubstr("face 1: vertex 5 of 5")));
  mesh.F(1, 2) = -1;
  EXPECT_THAT(CheckMesh(mesh), StatusIs(absl::StatusCode::kInvalidArgument,
                                        HasSubstr("face 1: vertex -1 of 5")));
}

TEST(CheckMesh, NamesTheVertexThatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = MakeTwoTriangles();
    mesh.V(3, 1) = bad;
    EXPECT_THAT(CheckMesh(mesh), StatusIs(absl::StatusCode::kInvalidArgument,
                                          HasSubstr("vertex 3")));
  }
}

TEST(ComputeVertexFaces, ListsTheFacesOfEachVertexInOrder) {
  const Adjacency adjacency = ComputeVertexFaces(MakeTwoTriangles());
  EXPECT_THAT(adjacency.offsets, ElementsAre(0, 1, 1, 3, 5, 6));
  EXPECT_THAT(adjacency.items, ElementsAre(0, 0, 1, 0, 1, 1));
}

TEST(ComputeVertexFaces, TakesTheEmptyMesh) {
  const Adjacency adjacency = ComputeVertexFaces(TriangleMesh{});
  EXPECT_THAT(adjacency.offsets, ElementsAre(0));
  EXPECT_THAT(adjacency.items, IsEmpty());
}

TEST(RemoveUnusedVertices, KeepsTheOrderAndTheGeometryOfTheOthers) {
  const TriangleMesh before = MakeTwoTriangles();
  TriangleMesh mesh = before;
  EXPECT_THAT(RemoveUnusedVertices(mesh), ElementsAre(0, 2, 3, 4));
  ASSERT_EQ(mesh.num_vertices(), 4);
  ASSERT_EQ(mesh.num_faces(), 2);
  for (int f = 0; f < 2; ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      EXPECT_EQ(mesh.vertex(mesh.F(f, corner)),
                before.vertex(before.F(f, corner)));
    }
  }
}

TEST(RemoveUnusedVertices, ChangesNothingWhenAllAreUsed) {
  TriangleMesh mesh = MakeTwoTriangles();
  RemoveUnusedVertices(mesh);
  const TriangleMesh once = mesh;
  EXPECT_THAT(RemoveUnusedVertices(mesh), ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(mesh.V, once.V);
  EXPECT_EQ(mesh.F, once.F);
}

}  // namespace
}  // namespace argmesh
