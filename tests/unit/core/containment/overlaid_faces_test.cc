#include "core/containment/overlaid_faces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/geometry/area.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

Eigen::Vector3d Middle(const TriangleMesh& mesh, int face) {
  return (mesh.vertex(mesh.F(face, 0)) + mesh.vertex(mesh.F(face, 1)) +
          mesh.vertex(mesh.F(face, 2))) /
         3;
}

// A turn, a scale and a shift, from a query's units to a target's.
Eigen::Matrix4d SomePlace(double scale) {
  Eigen::Matrix4d place = Eigen::Matrix4d::Identity();
  place.topLeftCorner<3, 3>() =
      scale *
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  place.topRightCorner<3, 1>() = Eigen::Vector3d(4, -1, 0.3);
  return place;
}

TriangleMesh Moved(TriangleMesh mesh, const Eigen::Matrix4d& by) {
  mesh.V = ((mesh.V * by.topLeftCorner<3, 3>().transpose()).rowwise() +
            by.topRightCorner<3, 1>().transpose())
               .eval();
  return mesh;
}

// The upper ball of a dumbbell, whose faces are the last ones.
TriangleMesh UpperHalf(const TriangleMesh& mesh) {
  TriangleMesh half = mesh;
  half.F.resize(0, 3);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    if (Middle(mesh, f).z() <= 0) continue;
    half.F.conservativeResize(half.F.rows() + 1, Eigen::NoChange);
    half.F.row(half.F.rows() - 1) = mesh.F.row(f);
  }
  RemoveUnusedVertices(half);
  return half;
}

TEST(OverlayFaces, FindsUnderEachSampleTheFaceItWasCutFrom) {
  const TriangleMesh piece = UpperHalf(MakeDumbbell());
  const Eigen::Matrix4d place = SomePlace(3);
  const TriangleMesh target = Moved(MakeDumbbell(), place);
  const double size = 3 * std::sqrt(ComputeFaceAreas(piece).sum());
  const auto pairs = OverlayFaces(piece, target, place);
  EXPECT_NEAR(static_cast<double>(pairs.size()), kOverlaidSamples, 1);
  const TriangleMesh laid = Moved(piece, place);
  int far = 0;
  for (const auto& [of_query, of_target] : pairs) {
    ASSERT_GE(of_query, 0);
    ASSERT_LT(of_query, piece.num_faces());
    ASSERT_GE(of_target, 0) << "every sample of a piece lies on its source";
    ASSERT_LT(of_target, target.num_faces());
    far += (Middle(laid, of_query) - Middle(target, of_target)).norm() >
           0.1 * size;
  }
  EXPECT_EQ(far, 0);
  EXPECT_EQ(OverlayFaces(piece, target, place), pairs);
}

TEST(OverlayFaces, LaysNothingOnWhatIsElsewhere) {
  Eigen::Matrix4d place = Eigen::Matrix4d::Identity();
  place(0, 3) = 100;
  const TriangleMesh mesh = MakeDumbbell();
  for (const auto& pair : OverlayFaces(mesh, mesh, place)) {
    EXPECT_EQ(pair[1], -1);
  }
}

TEST(OverlayFaces, DoesNotMindWhichSideIsOutside) {
  const TriangleMesh mesh = MakeTorus(2, 0.7, 40, 20);
  TriangleMesh inside_out = mesh;
  inside_out.F.col(1).swap(inside_out.F.col(2));
  for (const auto& pair :
       OverlayFaces(mesh, inside_out, Eigen::Matrix4d::Identity())) {
    EXPECT_GE(pair[1], 0);
  }
}

TEST(OverlayFaces, OfNoAreaIsNothing) {
  TriangleMesh flat = MakeSheet(2);
  flat.V.setZero();
  const TriangleMesh sheet = MakeSheet(2);
  const Eigen::Matrix4d same = Eigen::Matrix4d::Identity();
  EXPECT_TRUE(OverlayFaces(flat, sheet, same).empty());
  EXPECT_TRUE(OverlayFaces(sheet, flat, same).empty());
}

}  // namespace
}  // namespace argmesh
