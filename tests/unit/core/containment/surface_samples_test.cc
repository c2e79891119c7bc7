#include "core/containment/surface_samples.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/containment/open_orientation.h"
#include "core/geometry/area.h"
#include "core/synthesis/mesh_cut.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

TEST(SurfaceSamples, SpreadEvenlyWhateverTheTriangles) {
  // Half of the sheet in fine triangles, half in two.
  TriangleMesh mesh = MakeSheet(20);
  TriangleMesh coarse = MakeSheet(1);
  const TriangleMesh both = Join(mesh, Translated(coarse, {1, 0, 0}));
  const SurfaceSamples samples =
      SampleSurface(both, ComputeFaceAreas(both), 4000, 1);
  ASSERT_NEAR(static_cast<double>(samples.positions.size()), 4000, 1);
  for (const size_t head : {500u, 4000u}) {
    int right = 0;
    for (size_t i = 0; i < std::min(head, samples.positions.size()); ++i) {
      right += samples.positions[i].x() > 1;
    }
    EXPECT_NEAR(right / static_cast<double>(head), 0.5,
                2 / std::sqrt(static_cast<double>(head)));
  }
}

TEST(SurfaceSamples, DifferWithTheSeedOnly) {
  const TriangleMesh mesh = MakeDumbbell();
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  const SurfaceSamples a = SampleSurface(mesh, areas, 1000, 1);
  EXPECT_EQ(a.positions, SampleSurface(mesh, areas, 1000, 1).positions);
  EXPECT_NE(a.positions, SampleSurface(mesh, areas, 1000, 2).positions);
}

TEST(OpenBoundary, OfAClosedSurfaceIsEmpty) {
  EXPECT_TRUE(FindOpenBoundary(MakeDumbbell()).points.empty());
}

TEST(OpenBoundary, RunsAroundASheet) {
  const OpenBoundary boundary = FindOpenBoundary(MakeSheet(4));
  ASSERT_FALSE(boundary.points.empty());
  for (size_t i = 0; i < boundary.points.size(); ++i) {
    const Eigen::Vector3f& p = boundary.points[i];
    const float to_edge =
        std::min(std::min(p.x(), 1 - p.x()), std::min(p.y(), 1 - p.y()));
    EXPECT_NEAR(to_edge, 0, 1e-6);
    EXPECT_NEAR(boundary.extent[i], std::sqrt(2.0), 1e-5);
  }
}

TEST(OpenBoundary, IsNotWhereTwoSheetsMeet) {
  // The same border twice, under vertices of their own.
  const TriangleMesh sheet = MakeSheet(4);
  const TriangleMesh both = Join(sheet, Translated(sheet, {1, 0, 0}));
  for (const Eigen::Vector3f& p : FindOpenBoundary(both).points) {
    EXPECT_GT(std::abs(p.x() - 1) + std::min(p.y(), 1 - p.y()), 0)
        << p.transpose();
    EXPECT_FALSE(std::abs(p.x() - 1) < 1e-6 && p.y() > 0.01 && p.y() < 0.99)
        << p.transpose();
  }
}

TEST(OpenBoundary, LeavesPinholesOutOfWideWindows) {
  TriangleMesh sheet = MakeSheet(20);
  // One face of the middle goes.
  const int hole = 20 * 20 + 20;
  FaceMatrix faces(sheet.F.rows() - 1, 3);
  faces << sheet.F.topRows(hole), sheet.F.bottomRows(sheet.F.rows() - hole - 1);
  sheet.F = faces;
  const OpenBoundary boundary = FindOpenBoundary(sheet);
  const size_t narrow = BoundaryForRadius(boundary, 0.05F).size();
  const size_t wide = BoundaryForRadius(boundary, 1).size();
  EXPECT_EQ(narrow, boundary.points.size());
  EXPECT_LT(wide, narrow);
  EXPECT_GT(wide, 0u);
}

double Volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    volume +=
        mesh.vertex(mesh.F(f, 0))
            .dot(mesh.vertex(mesh.F(f, 1)).cross(mesh.vertex(mesh.F(f, 2)))) /
        6;
  }
  return volume;
}

TEST(OpenOrientation, TurnsABallWithAHoleOutwards) {
  const TriangleMesh ball = MakeRevolution(
      {{-1, 0.2}, {-0.7, 0.7}, {0, 1}, {0.7, 0.7}, {1, 0.2}}, 24);
  const TriangleMesh open = CutByPlane(ball, {Eigen::Vector3d::UnitZ(), -0.6});
  TriangleMesh inside_out = open;
  inside_out.F.col(1).swap(inside_out.F.col(2));
  ASSERT_LT(Volume(inside_out), 0);
  OrientOpenPieces(inside_out);
  EXPECT_GT(Volume(inside_out), 0);
  TriangleMesh right = open;
  OrientOpenPieces(right);
  EXPECT_EQ(right.F, open.F);
}

TEST(OpenOrientation, LeavesASheetAlone) {
  TriangleMesh sheet = MakeSheet(3);
  sheet.F.col(1).swap(sheet.F.col(2));
  const FaceMatrix before = sheet.F;
  OrientOpenPieces(sheet);
  EXPECT_EQ(sheet.F, before);
}

}  // namespace
}  // namespace argmesh
