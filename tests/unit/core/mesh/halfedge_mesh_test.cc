#include "core/mesh/halfedge_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

FaceMatrix Tetrahedron() {
  FaceMatrix F(4, 3);
  F << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  return F;
}

TEST(HalfedgeMesh, NamesTheFaceThatTurnsTheOtherWay) {
  FaceMatrix F(2, 3);
  F << 0, 1, 2, 0, 1, 3;
  EXPECT_THAT(HalfedgeMesh::Create(F, 4),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("face 1 (0, 1, 3)")));
}

TEST(HalfedgeMesh, NamesAVertexWithoutAFace) {
  EXPECT_THAT(HalfedgeMesh::Create(Tetrahedron(), 5),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("vertex 4 has no face")));
}

TEST(HalfedgeMesh, WalksTheRingOfABoundaryVertexFromGapToGap) {
  const TriangleMesh sheet = MakeSheet(4);
  ASSERT_OK_AND_ASSIGN(const HalfedgeMesh halfedges,
                       HalfedgeMesh::Create(sheet.F, sheet.num_vertices()));
  std::vector<int32_t> ring;
  int boundary = 0;
  for (int32_t v = 0; v < sheet.num_vertices(); ++v) {
    halfedges.GetRing(v, ring);
    boundary += halfedges.IsBoundary(v) ? 1 : 0;
    size_t faces = 0;
    for (int f = 0; f < sheet.num_faces(); ++f) {
      faces += (sheet.F.row(f).array() == v).any() ? 1U : 0U;
    }
    EXPECT_EQ(ring.size(), faces + (halfedges.IsBoundary(v) ? 1U : 0U));
  }
  EXPECT_EQ(boundary, 16);
}

TEST(HalfedgeMesh, RefusesToFlattenATetrahedron) {
  ASSERT_OK_AND_ASSIGN(const HalfedgeMesh halfedges,
                       HalfedgeMesh::Create(Tetrahedron(), 4));
  for (int32_t a = 0; a < 4; ++a) {
    for (int32_t b = 0; b < 4; ++b) {
      EXPECT_FALSE(a != b && halfedges.CanCollapse(a, b)) << a << " " << b;
    }
  }
}

TEST(HalfedgeMesh, RefusesToCollapseTheLastTriangle) {
  FaceMatrix F(1, 3);
  F << 0, 1, 2;
  ASSERT_OK_AND_ASSIGN(const HalfedgeMesh halfedges,
                       HalfedgeMesh::Create(F, 3));
  EXPECT_FALSE(halfedges.CanCollapse(0, 1));
}

TEST(HalfedgeMesh, RefusesToJoinTwoBoundariesAcrossTheInterior) {
  // Two triangles: the diagonal runs between two boundary vertices.
  FaceMatrix F(2, 3);
  F << 0, 1, 2, 0, 2, 3;
  ASSERT_OK_AND_ASSIGN(const HalfedgeMesh halfedges,
                       HalfedgeMesh::Create(F, 4));
  EXPECT_FALSE(halfedges.CanCollapse(0, 2));
  EXPECT_TRUE(halfedges.CanCollapse(0, 1));
}

TEST(HalfedgeMesh, LosesAVertexAndTwoFacesWithACollapse) {
  const TriangleMesh torus = MakeTorus(2, 1, 12, 9);
  ASSERT_OK_AND_ASSIGN(HalfedgeMesh halfedges,
                       HalfedgeMesh::Create(torus.F, torus.num_vertices()));
  const int32_t from = torus.F(0, 0);
  const int32_t to = torus.F(0, 1);
  ASSERT_TRUE(halfedges.CanCollapse(from, to));
  halfedges.Collapse(from, to);
  EXPECT_FALSE(halfedges.IsAlive(from));
  EXPECT_TRUE(halfedges.IsAlive(to));
  const FaceMatrix F = halfedges.CopyFaces();
  EXPECT_EQ(F.rows(), torus.F.rows() - 2);
  EXPECT_FALSE((F.array() == from).any());
}

}  // namespace
}  // namespace argmesh
