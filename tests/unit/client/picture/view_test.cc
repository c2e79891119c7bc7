#include "client/picture/view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/synthesis/mesh_similarity.h"
#include "core/synthesis/sample_shape.h"

namespace argmesh {
namespace {

TriangleMesh SampleMesh(const char* name) {
  return MakeSampleShape(name, 1, {.target_vertices = 2000}).value().mesh;
}

TEST(FitView, FillsThePictureAndStaysInside) {
  const TriangleMesh mesh = SampleMesh("airplane");
  const View view = FitView(mesh, 400, 300);
  const Eigen::Vector3d along_x = view.right * view.pixels_per_unit;
  const Eigen::Vector3d along_y = view.up * view.pixels_per_unit;
  double widest = 0;
  double highest = 0;
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    const Eigen::Vector3d p = mesh.vertex(v) - view.center;
    widest = std::max(widest, std::abs(p.dot(along_x)));
    highest = std::max(highest, std::abs(p.dot(along_y)));
  }
  EXPECT_LE(widest, 200 - 14.9);
  EXPECT_LE(highest, 150 - 14.9);
  EXPECT_TRUE(widest > 184 || highest > 134);
}

TEST(FitView, IsARightHandedOrthonormalFrame) {
  for (const bool standing : {false, true}) {
    ViewOptions options;
    if (standing) options.up = Eigen::Vector3d(0, 0, 2);
    const View view = FitView(SampleMesh("fish"), 300, 300, options);
    EXPECT_TRUE(view.right.cross(view.up).isApprox(view.toward, 1e-12));
    EXPECT_NEAR(view.right.norm(), 1, 1e-12);
    EXPECT_NEAR(view.up.norm(), 1, 1e-12);
  }
}

TEST(FitView, LooksDownOnAShapeThatStands) {
  ViewOptions options{.up = Eigen::Vector3d::UnitZ(),
                      .front = -Eigen::Vector3d::UnitY(),
                      .yaw_degrees = 0,
                      .pitch_degrees = 0};
  const TriangleMesh chair = SampleMesh("chair");
  View view = FitView(chair, 300, 300, options);
  EXPECT_TRUE(view.toward.isApprox(-Eigen::Vector3d::UnitY(), 1e-9));
  EXPECT_TRUE(view.right.isApprox(Eigen::Vector3d::UnitX(), 1e-9));
  options.pitch_degrees = 30;
  view = FitView(chair, 300, 300, options);
  EXPECT_NEAR(view.toward.z(), 0.5, 1e-9);
  EXPECT_GT(view.up.z(), 0);
}

TEST(FitView, TurnsWithTheShapeWhenItChoosesForItself) {
  const TriangleMesh mesh = SampleMesh("quadruped");
  const View view = FitView(mesh, 300, 300);
  const TriangleMesh turned = RandomSimilarity(mesh, 12, {.renumber = false});
  const View turned_view = FitView(turned, 300, 300);
  for (int v = 0; v < mesh.num_vertices(); v += 50) {
    const Eigen::Vector3d p = mesh.vertex(v) - view.center;
    const Eigen::Vector3d q = turned.vertex(v) - turned_view.center;
    EXPECT_NEAR(view.pixels_per_unit * p.dot(view.right),
                turned_view.pixels_per_unit * q.dot(turned_view.right), 1e-4);
    EXPECT_NEAR(view.pixels_per_unit * p.dot(view.up),
                turned_view.pixels_per_unit * q.dot(turned_view.up), 1e-4);
  }
}

}  // namespace
}  // namespace argmesh
