#include "core/mesh/mesh_canonical.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_weld.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

constexpr double kGridCell = 1.0 / 4194304;

// A torus pulled out of every symmetry.
TriangleMesh MakeLopsided(uint64_t seed, int major, int minor) {
  TriangleMesh mesh = MakeTorus(2, 0.7, major, minor);
  Random random(seed);
  const double x = random.Uniform(0.1, 0.2);
  const double y = random.Uniform(0.1, 0.2);
  for (Eigen::Index v = 0; v < mesh.V.rows(); ++v) {
    const Eigen::RowVector3d p = mesh.V.row(v);
    mesh.V.row(v) << p.x() * (1 + x * p.x()) + 0.1 * p.y(),
        p.y() * (0.6 + y * p.y()), p.z() * (1 + 0.2 * p.x() + 0.3 * p.y());
  }
  return mesh;
}

TEST(CanonicalizeMesh, MakesSimilarCopiesEqualBitForBit) {
  int equal = 0;
  constexpr int kCopies = 100;
  for (uint64_t seed = 0; seed < kCopies; ++seed) {
    const TriangleMesh mesh = MakeLopsided(seed, 24, 12);
    ASSERT_OK_AND_ASSIGN(const CanonicalMesh a, CanonicalizeMesh(mesh));
    ASSERT_OK_AND_ASSIGN(const CanonicalMesh b,
                         CanonicalizeMesh(RandomlyMoved(mesh, seed + 1000)));
    EXPECT_FALSE(a.ambiguous) << seed;
    EXPECT_FALSE(b.ambiguous) << seed;
    if (a.mesh.V == b.mesh.V && a.mesh.F == b.mesh.F) ++equal;
  }
  // A coordinate within rounding of a grid middle is rare, not impossible.
  EXPECT_GE(equal, kCopies - 1);
}

TEST(CanonicalizeMesh, TellsAMirroredCopyApart) {
  const TriangleMesh mesh = MakeLopsided(3, 24, 12);
  TriangleMesh mirrored = mesh;
  mirrored.V.col(0) *= -1;
  for (int f = 0; f < mirrored.num_faces(); ++f) {
    std::swap(mirrored.F(f, 1), mirrored.F(f, 2));
  }
  ASSERT_OK_AND_ASSIGN(const CanonicalMesh a, CanonicalizeMesh(mesh));
  ASSERT_OK_AND_ASSIGN(const CanonicalMesh b, CanonicalizeMesh(mirrored));
  EXPECT_NE(a.mesh.V, b.mesh.V);
}

TEST(CanonicalizeMesh, SaysHowItMovedTheMesh) {
  const TriangleMesh mesh = RandomlyMoved(MakeLopsided(8, 24, 12), 5);
  ASSERT_OK_AND_ASSIGN(const CanonicalMesh canonical, CanonicalizeMesh(mesh));
  EXPECT_NEAR(canonical.rotation.determinant(), 1, 1e-12);
  ASSERT_EQ(canonical.source_face.size(), Slot(mesh.num_faces()));
  const auto map = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return canonical.rotation *
           ((x - canonical.unit_area.centroid) * canonical.unit_area.scale);
  };
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const int source = canonical.source_face[Slot(f)];
    const Eigen::Vector3d expected =
        map((mesh.vertex(mesh.F(source, 0)) + mesh.vertex(mesh.F(source, 1)) +
             mesh.vertex(mesh.F(source, 2))) /
            3);
    const TriangleMesh& to = canonical.mesh;
    const Eigen::Vector3d centroid =
        (to.vertex(to.F(f, 0)) + to.vertex(to.F(f, 1)) +
         to.vertex(to.F(f, 2))) /
        3;
    EXPECT_LT((centroid - expected).norm(), 2e-5);
    EXPECT_GT(
        FaceCross(to, f).dot(canonical.rotation * FaceCross(mesh, source)), 0);
  }
}

TEST(CanonicalizeMesh, RoundsPositionsAndSortsFaces) {
  ASSERT_OK_AND_ASSIGN(const CanonicalMesh canonical,
                       CanonicalizeMesh(MakeLopsided(1, 24, 12)));
  const VertexMatrix& V = canonical.mesh.V;
  for (Eigen::Index v = 0; v < V.rows(); ++v) {
    const Eigen::RowVector3d grid = V.row(v) / kGridCell;
    EXPECT_EQ(grid, grid.array().round().matrix());
  }
  const FaceMatrix& F = canonical.mesh.F;
  for (Eigen::Index f = 0; f < F.rows(); ++f) {
    EXPECT_EQ(F.row(f).minCoeff(), F(f, 0));
    if (f > 0) {
      EXPECT_TRUE(
          std::lexicographical_compare(F.row(f - 1).begin(), F.row(f - 1).end(),
                                       F.row(f).begin(), F.row(f).end()));
    }
  }
}

// A regular sheet, whose vertices lie in rows along the axes, a little bent.
TEST(CanonicalizeMesh, KeepsTheOrderWhenPositionsAreRounded) {
  TriangleMesh mesh = MakeSheet(20);
  for (Eigen::Index v = 0; v < mesh.V.rows(); ++v) {
    const double x = mesh.V(v, 0);
    const double y = mesh.V(v, 1);
    mesh.V(v, 2) = 0.1 * x * x + 0.03 * y * y * y;
  }
  mesh.V.col(0) *= 1.5;
  TriangleMesh printed = RandomlyMoved(mesh, 12);
  printed.V = printed.V.cast<float>().cast<double>().eval();
  ASSERT_OK_AND_ASSIGN(const CanonicalMesh a, CanonicalizeMesh(mesh));
  ASSERT_OK_AND_ASSIGN(const CanonicalMesh b, CanonicalizeMesh(printed));
  EXPECT_LT((a.mesh.V - b.mesh.V).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_EQ(a.mesh.F, b.mesh.F);
}

TEST(CanonicalizeMesh, KeepsVerticesApartThatLieTogether) {
  const TriangleMesh torus = MakeLopsided(2, 12, 6);
  const TriangleMesh twice = Join(torus, torus);
  ASSERT_OK_AND_ASSIGN(const CanonicalMesh canonical, CanonicalizeMesh(twice));
  EXPECT_EQ(canonical.mesh.num_vertices(), 2 * torus.num_vertices());
  for (const auto& ends :
       ComputeMeshEdges(canonical.mesh.F, canonical.mesh.num_vertices()).ends) {
    EXPECT_NE(canonical.mesh.V.row(ends[0]), canonical.mesh.V.row(ends[1]));
  }
}

TEST(CanonicalizeMesh, CallsSymmetricSurfacesAmbiguous) {
  for (const TriangleMesh& mesh :
       {MakeTorus(2, 1, 24, 12), MakeSheet(4), MakeDumbbell(16)}) {
    ASSERT_OK_AND_ASSIGN(const CanonicalMesh canonical, CanonicalizeMesh(mesh));
    EXPECT_TRUE(canonical.ambiguous);
  }
}

TEST(CanonicalizeMesh, IsACanonicalFormOfItself) {
  ASSERT_OK_AND_ASSIGN(const CanonicalMesh once,
                       CanonicalizeMesh(MakeLopsided(4, 24, 12)));
  ASSERT_OK_AND_ASSIGN(const CanonicalMesh twice, CanonicalizeMesh(once.mesh));
  EXPECT_LT((once.mesh.V - twice.mesh.V).cwiseAbs().maxCoeff(), 4 * kGridCell);
}

TEST(CanonicalizeMesh, RefusesWhatHasNoArea) {
  EXPECT_THAT(CanonicalizeMesh(TriangleMesh{}),
              StatusIs(absl::StatusCode::kFailedPrecondition, testing::_));
  TriangleMesh bad = MakeSheet(2);
  bad.V(1, 1) = std::nan("");
  EXPECT_THAT(CanonicalizeMesh(bad),
              StatusIs(absl::StatusCode::kInvalidArgument, testing::_));
}

}  // namespace
}  // namespace argmesh
