#include "core/geometry/curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/geometry/area.h"
#include "tests/unit/core/geometry/closed_form_meshes.h"

namespace argmesh {
namespace {

VertexMatrix CylinderNormals(const TriangleMesh& mesh) {
  return NormalsBy(mesh, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), 0);
  });
}

TEST(ComputeCurvatures, AreExactOnASphereWithItsOwnNormals) {
  for (const double r : {0.2, 1.0, 30.0}) {
    const TriangleMesh sphere = MakeIrregularSphere(6, r, 31);
    const VertexMatrix normals =
        NormalsBy(sphere, [](const Eigen::Vector3d& p) { return p; });
    // The place in space must not matter.
    const TriangleMesh mesh = Moved(sphere, Eigen::Matrix3d::Identity(), 1,
                                    {100 * r, -50 * r, 7 * r});
    const SurfaceGraph graph = BuildSurfaceGraph(mesh);
    for (const double radius : {0.0, 0.3 * r, 1.0 * r}) {
      const Curvatures c = ComputeCurvatures(mesh, normals, graph, radius);
      EXPECT_LT((c.mean.array() * r - 1).abs().maxCoeff(), 1e-9);
      EXPECT_LT((c.gaussian.array() * r * r - 1).abs().maxCoeff(), 1e-9);
    }
  }
}

TEST(ComputeCurvatures, AreCloseOnAnIrregularSphereWithEstimatedNormals) {
  const TriangleMesh mesh = MakeIrregularSphere(16, 1, 32);
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  const VertexMatrix normals = ComputeSmoothedNormals(
      mesh, ComputeVertexNormals(mesh), ComputeVertexAreas(mesh), graph, 0.15);
  const Curvatures c = ComputeCurvatures(mesh, normals, graph, 0.3);
  EXPECT_NEAR(c.mean.mean(), 1, 0.01);
  EXPECT_LT((c.mean.array() - 1).abs().maxCoeff(), 0.08);
  EXPECT_LT((c.gaussian.array() - 1).abs().maxCoeff(), 0.15);
}

TEST(ComputeCurvatures, ChangeSignOnlyInTheMeanWhenTheSurfaceIsInverted) {
  TriangleMesh mesh = MakeIrregularSphere(8, 2, 33);
  mesh.F.col(1).swap(mesh.F.col(2));
  const VertexMatrix inward = NormalsBy(
      mesh, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(-p); });
  const Curvatures c =
      ComputeCurvatures(mesh, inward, BuildSurfaceGraph(mesh), 0.5);
  EXPECT_LT((c.mean.array() + 0.5).abs().maxCoeff(), 1e-9);
  EXPECT_LT((c.gaussian.array() - 0.25).abs().maxCoeff(), 1e-9);
}

TEST(ComputeCurvatures, OfACylinderAreHalfItsInverseRadiusAndZero) {
  const TriangleMesh mesh = MakeOpenCylinder(0.5, 3, 50, 40, true);
  const Curvatures c = ComputeCurvatures(mesh, CylinderNormals(mesh),
                                         BuildSurfaceGraph(mesh), 0.2);
  EXPECT_LT((c.mean.array() - 1).abs().maxCoeff(), 0.01);
  EXPECT_LT(c.gaussian.cwiseAbs().maxCoeff(), 0.01);
}

TEST(ComputeCurvatures, OfATorusFollowItsParallels) {
  const double R = 1;
  const double r = 0.4;
  const TriangleMesh mesh = MakeTorus(R, r, 150, 60);
  const VertexMatrix normals = NormalsBy(mesh, [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d ring =
        Eigen::Vector3d(p.x(), p.y(), 0).normalized() * R;
    return Eigen::Vector3d(p - ring);
  });
  const Curvatures c =
      ComputeCurvatures(mesh, normals, BuildSurfaceGraph(mesh), 0.07);
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    const double b = 2 * std::numbers::pi * (v % 60) / 60;
    const double parallel = R + r * std::cos(b);
    ASSERT_NEAR(c.mean[v], (R + 2 * r * std::cos(b)) / (2 * r * parallel),
                0.03);
    // From -4.2 to 1.8; which vertices the ball's edge takes is a matter of
    // rounding.
    ASSERT_NEAR(c.gaussian[v], std::cos(b) / (r * parallel), 0.1);
  }
}

TEST(ComputeCurvatures, IntegrateToTheEulerCharacteristic) {
  const TriangleMesh sphere = MakeIrregularSphere(12, 1.7, 34);
  const TriangleMesh torus = MakeTorus(1, 0.3, 60, 30);
  for (const auto& [mesh, integral] :
       {std::pair(sphere, 4 * std::numbers::pi), std::pair(torus, 0.0)}) {
    const Eigen::VectorXd areas = ComputeVertexAreas(mesh);
    const Curvatures c = ComputeCurvatures(mesh, ComputeVertexNormals(mesh),
                                           BuildSurfaceGraph(mesh), 0);
    EXPECT_NEAR(c.gaussian.dot(areas), integral, 0.03 * 4 * std::numbers::pi);
  }
}

// Schwarz' lantern: its vertices lie on a cylinder, but its faces are steep
// and its area is far too large, however fine it is. Curvature from faces and
// edges (the normal cycle) does not converge on it.
TEST(ComputeCurvatures, AreExactOnASchwarzLantern) {
  for (const int around : {16, 32}) {
    const int rings = around * around / 5 + 1;
    const TriangleMesh mesh = MakeOpenCylinder(1, 1, around, rings, true);
    EXPECT_GT(ComputeFaceAreas(mesh).sum(), 1.2 * 2 * std::numbers::pi);
    const Curvatures c = ComputeCurvatures(mesh, CylinderNormals(mesh),
                                           BuildSurfaceGraph(mesh), 0.2);
    EXPECT_LT((c.mean.array() - 0.5).abs().maxCoeff(), 1e-9);
    EXPECT_LT(c.gaussian.cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(ComputeCurvatures, AreZeroWithoutArea) {
  TriangleMesh mesh;
  mesh.V = VertexMatrix::Zero(3, 3);
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  const Curvatures c = ComputeCurvatures(mesh, ComputeVertexNormals(mesh),
                                         BuildSurfaceGraph(mesh), 1);
  EXPECT_EQ(c.mean.norm(), 0);
  EXPECT_EQ(c.gaussian.norm(), 0);
}

TEST(ComputeCurvatures, StayBoundedWhereNormalsContradictTheFaces) {
  TriangleMesh mesh = MakeIcosphere(4, 1);
  VertexMatrix normals = VertexMatrix::Zero(mesh.num_vertices(), 3);
  normals.col(2).setOnes();
  normals.row(0) << 0, 0, -1;
  const Curvatures c =
      ComputeCurvatures(mesh, normals, BuildSurfaceGraph(mesh), 0.3);
  EXPECT_TRUE(c.mean.allFinite());
  EXPECT_LT(c.mean.cwiseAbs().maxCoeff(), 100);
}

TEST(ComputeCurvatures, RepeatAndIgnoreRigidMotion) {
  const TriangleMesh mesh = MakeTorus(1, 0.4, 40, 20);
  const VertexMatrix normals = ComputeVertexNormals(mesh);
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  const Curvatures a = ComputeCurvatures(mesh, normals, graph, 0.2);
  const Curvatures again = ComputeCurvatures(mesh, normals, graph, 0.2);
  EXPECT_EQ(a.mean, again.mean);
  EXPECT_EQ(a.gaussian, again.gaussian);
  // 0 keeps the ball's edge out of rounding's reach.
  const Curvatures own = ComputeCurvatures(mesh, normals, graph, 0);
  const TriangleMesh moved = Moved(mesh, RandomRotation(35), 1, {3, -1, 2});
  const Curvatures b = ComputeCurvatures(moved, ComputeVertexNormals(moved),
                                         BuildSurfaceGraph(moved), 0);
  EXPECT_LT((own.mean - b.mean).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((own.gaussian - b.gaussian).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ComputeSmoothedNormals, AverageNoiseAway) {
  const TriangleMesh mesh = MakeIrregularSphere(16, 1, 36);
  const VertexMatrix exact =
      NormalsBy(mesh, [](const Eigen::Vector3d& p) { return p; });
  const VertexMatrix raw = ComputeVertexNormals(mesh);
  const VertexMatrix smoothed = ComputeSmoothedNormals(
      mesh, raw, ComputeVertexAreas(mesh), BuildSurfaceGraph(mesh), 0.25);
  EXPECT_LT((smoothed - exact).norm(), 0.6 * (raw - exact).norm());
  EXPECT_LT((smoothed.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(ComputeSmoothedNormals, KeepTheOwnNormalAtRadiusZeroAndWhereTheyCancel) {
  const TriangleMesh mesh = MakeIcosphere(4, 1);
  const VertexMatrix normals = ComputeVertexNormals(mesh);
  const Eigen::VectorXd areas = ComputeVertexAreas(mesh);
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  EXPECT_LT(
      (ComputeSmoothedNormals(mesh, normals, areas, graph, 0) - normals).norm(),
      1e-12);
  // Over the whole sphere they sum to zero.
  const VertexMatrix whole =
      ComputeSmoothedNormals(mesh, normals, areas, graph, 100);
  EXPECT_LT((whole - normals).norm(), 1e-12);
}

}  // namespace
}  // namespace argmesh
