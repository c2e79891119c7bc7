#include "core/signature/signature_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/area.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_repair.h"
#include "core/signature/implicit_smoothing.h"
#include "core/signature/outside_vote.h"
#include "core/synthesis/mesh_noise.h"
#include "core/synthesis/mesh_similarity.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

TriangleMesh MakeBall() {
  std::vector<Eigen::Vector2d> profile;
  for (int i = 1; i < 24; ++i) {
    const double angle = 3.14159265358979 * i / 24;
    profile.emplace_back(-std::cos(angle), std::sin(angle));
  }
  return MakeRevolution(profile, 36);
}

TEST(PrepareSurface, HasUnitAreaAndItsCentroidInTheOrigin) {
  const TriangleMesh mesh = RandomlyMoved(MakeDumbbell(), 3);
  ASSERT_OK_AND_ASSIGN(const SignatureSurface surface, PrepareSurface(mesh));
  EXPECT_TRUE(surface.smoothed);
  EXPECT_NEAR(surface.face_areas.sum(), 1, 1e-9);
  Eigen::RowVector3d centroid = Eigen::RowVector3d::Zero();
  for (int f = 0; f < surface.mesh.num_faces(); ++f) {
    EXPECT_NEAR(surface.face_normals.row(f).norm(), 1, 1e-9);
    for (int c = 0; c < 3; ++c) {
      centroid +=
          surface.face_areas[f] / 3 * surface.mesh.V.row(surface.mesh.F(f, c));
    }
  }
  EXPECT_LT(centroid.norm(), 1e-9);
}

TEST(PrepareSurface, DoesNotSmoothWhatIsFullOfHoles) {
  ASSERT_OK_AND_ASSIGN(
      const SignatureSurface soup,
      PrepareSurface(MakeSoup(RemoveFaces(MakeBall(), 0.1, 1))));
  EXPECT_FALSE(soup.smoothed);
  SignatureOptions options;
  options.max_boundary_share = 1;
  ASSERT_OK_AND_ASSIGN(const SignatureSurface sheet,
                       PrepareSurface(MakeSheet(6), options));
  EXPECT_TRUE(sheet.smoothed);
}

TEST(PrepareSurface, TurnsSoupInsideOutTheRightWayRound) {
  TriangleMesh mesh = MakeSoup(MakeBall());
  for (int f = 0; f < mesh.num_faces(); f += 2) {
    std::swap(mesh.F(f, 1), mesh.F(f, 2));
  }
  // Leaves a hole in the pole so that the ball is open once it is welded.
  mesh.F = FaceMatrix(mesh.F.topRows(mesh.num_faces() - 20));
  ASSERT_OK_AND_ASSIGN(const SignatureSurface surface, PrepareSurface(mesh));
  double outward = 0;
  for (int f = 0; f < surface.mesh.num_faces(); ++f) {
    const Eigen::Vector3d middle = (surface.mesh.vertex(surface.mesh.F(f, 0)) +
                                    surface.mesh.vertex(surface.mesh.F(f, 1)) +
                                    surface.mesh.vertex(surface.mesh.F(f, 2))) /
                                   3;
    if (surface.face_normals.row(f).dot(middle) > 0) {
      outward += surface.face_areas[f];
    }
  }
  EXPECT_GT(outward, 0.98);
}

TEST(SmoothImplicitly, TakesNoiseAwayAndKeepsTheShape) {
  const TriangleMesh ball = MakeBall();
  TriangleMesh noisy = AddNoise(ball, 0.01, 1);
  const auto roughness = [](const TriangleMesh& mesh) {
    const Eigen::VectorXd radii = mesh.V.rowwise().norm();
    return std::sqrt((radii.array() - radii.mean()).square().mean());
  };
  const double before = roughness(noisy);
  const MeshEdges edges = ComputeMeshEdges(noisy.F, noisy.num_vertices());
  ASSERT_THAT(SmoothImplicitly(edges, 1e-3, {}, noisy), IsOk());
  EXPECT_LT(roughness(noisy), before / 2);
  EXPECT_NEAR(noisy.V.rowwise().norm().mean(), 1, 0.03);
}

TEST(SmoothImplicitly, StopsWhenAskedTo) {
  TriangleMesh ball = MakeBall();
  std::stop_source source;
  source.request_stop();
  const MeshEdges edges = ComputeMeshEdges(ball.F, ball.num_vertices());
  EXPECT_THAT(SmoothImplicitly(
                  edges, 1e-3,
                  StopToken(source.get_token(), absl::InfiniteFuture()), ball),
              StatusIs(absl::StatusCode::kCancelled, testing::_));
}

TEST(TurnOpenPiecesOut, LeavesClosedPiecesAlone) {
  TriangleMesh inside_out = MakeBall();
  inside_out.F.col(1).swap(inside_out.F.col(2));
  const FaceMatrix faces = inside_out.F;
  ASSERT_THAT(TurnOpenPiecesOut({}, inside_out), IsOk());
  EXPECT_EQ(inside_out.F, faces);
}

}  // namespace
}  // namespace argmesh
