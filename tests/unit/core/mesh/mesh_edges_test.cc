#include "core/mesh/mesh_edges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;

TEST(ComputeMeshEdges, ListsSortedEdgesWithTheirSides) {
  FaceMatrix F(2, 3);
  F << 2, 0, 1,  // sides 2-0, 0-1, 1-2
      1, 2, 3;   // sides 1-2, 2-3, 3-1
  const MeshEdges edges = ComputeMeshEdges(F, 4);
  using Ends = std::array<int32_t, 2>;
  EXPECT_THAT(edges.ends, ElementsAre(Ends{0, 1}, Ends{0, 2}, Ends{1, 2},
                                      Ends{1, 3}, Ends{2, 3}));
  EXPECT_THAT(edges.sides_of(2), ElementsAre(2, 3));
  EXPECT_THAT(ComputeTwins(edges, 2), ElementsAre(-1, -1, 3, 2, -1, -1));
}

TEST(ComputeMeshEdges, LeavesOutSidesFromAVertexToItself) {
  FaceMatrix F(1, 3);
  F << 0, 0, 1;
  const MeshEdges edges = ComputeMeshEdges(F, 2);
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_THAT(edges.sides_of(0), ElementsAre(1, 2));
}

TEST(ComputeMeshEdges, CountsThreeEdgesForTwoFacesOfAClosedMesh) {
  const TriangleMesh torus = MakeTorus(2, 1, 9, 7);
  const MeshEdges edges = ComputeMeshEdges(torus.F, torus.num_vertices());
  EXPECT_EQ(2 * edges.size(), 3 * Slot(torus.num_faces()));
  const std::vector<int32_t> twins = ComputeTwins(edges, torus.num_faces());
  for (size_t side = 0; side < twins.size(); ++side) {
    ASSERT_GE(twins[side], 0);
    EXPECT_EQ(twins[Slot(twins[side])], static_cast<int32_t>(side));
  }
}

TEST(ComputeTwins, JoinsNothingAtAnEdgeOfThreeFaces) {
  FaceMatrix F(3, 3);
  F << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  const MeshEdges edges = ComputeMeshEdges(F, 5);
  EXPECT_THAT(ComputeTwins(edges, 3), ::testing::Each(-1));
}

}  // namespace
}  // namespace argmesh
