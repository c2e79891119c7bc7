#include "core/geometry/shape_diameter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/geometry/area.h"
#include "core/geometry/ray_scene.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/core/geometry/closed_form_meshes.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

// The robust mean over the whole cone of 60 degrees, by a fine sampling of
// directions (z inwards) whose chord is known.
double ConeAverage(const std::function<double(const Eigen::Vector3d&)>& chord) {
  std::vector<double> t;
  std::vector<double> weight;
  for (int i = 0; i < 300; ++i) {
    const double z = 0.5 + 0.5 * (i + 0.5) / 300;
    for (int j = 0; j < 60; ++j) {
      const double a = 2 * std::numbers::pi * j / 60;
      const double r = std::sqrt(1 - z * z);
      t.push_back(chord({r * std::cos(a), r * std::sin(a), z}));
      weight.push_back(z);
    }
  }
  const Eigen::Map<const Eigen::ArrayXd> all(
      t.data(), static_cast<Eigen::Index>(t.size()));
  const double deviation = std::sqrt((all - all.mean()).square().mean());
  std::vector<double> sorted = t;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  double sum = 0;
  double total = 0;
  for (size_t i = 0; i < t.size(); ++i) {
    if (std::abs(t[i] - median) > deviation) continue;
    sum += t[i] * weight[i];
    total += weight[i];
  }
  return sum / total;
}

absl::StatusOr<Eigen::VectorXd> Compute(
    const TriangleMesh& mesh, const ShapeDiameterOptions& options = {}) {
  return ComputeShapeDiameter(mesh, ComputeVertexNormals(mesh),
                              BuildSurfaceGraph(mesh), options);
}

TEST(ComputeShapeDiameter, OfASphereIsTheMeanOfItsChords) {
  for (const double radius : {0.001, 1.0, 500.0}) {
    const TriangleMesh mesh =
        Moved(MakeIrregularSphere(12, radius, 41), RandomRotation(41), 1,
              {3 * radius, 0, -9 * radius});
    ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd diameter, Compute(mesh));
    const double expected =
        ConeAverage([&](const auto& d) { return 2 * radius * d.z(); });
    EXPECT_NEAR(expected, 1.519 * radius, 0.002 * radius);
    EXPECT_NEAR(diameter.mean(), expected, 0.03 * expected);
    EXPECT_GT(diameter.minCoeff(), 0.9 * expected);
    EXPECT_LT(diameter.maxCoeff(), 1.1 * expected);
  }
}

TEST(ComputeShapeDiameter, OfASlabFollowsItsThickness) {
  const double expected = ConeAverage([](const auto& d) { return 1 / d.z(); });
  for (const double thickness : {0.05, 0.1, 0.2}) {
    const TriangleMesh mesh = MakeBox({2, 2, thickness}, 0.1);
    ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd diameter, Compute(mesh));
    int middle = 0;
    for (int v = 0; v < mesh.num_vertices(); ++v) {
      if ((mesh.V.row(v).head(2).array() - 1).abs().maxCoeff() > 0.4) continue;
      EXPECT_NEAR(diameter[v], expected * thickness,
                  0.03 * expected * thickness);
      ++middle;
    }
    EXPECT_GT(middle, 50);
  }
}

TEST(ComputeShapeDiameter, OfALongTubeFollowsItsRadius) {
  const double r = 0.1;
  const TriangleMesh mesh = MakeOpenCylinder(r, 4, 32, 80, true);
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd diameter, Compute(mesh));
  const double expected = ConeAverage([&](const auto& d) {
    return 2 * r * d.z() / (d.z() * d.z() + d.x() * d.x());
  });
  for (int v = 20 * 32; v < 60 * 32; ++v) {
    ASSERT_NEAR(diameter[v], expected, 0.05 * expected) << v;
  }
}

TEST(ComputeShapeDiameter, IgnoresFacesThatARayEntersThrough) {
  // A small closed ball inside a large one: rays from the outer shell pass
  // the near side of the ball and stop where they leave it.
  const TriangleMesh outer = MakeIcosphere(8, 1);
  const TriangleMesh inner = MakeIcosphere(8, 0.4);
  const TriangleMesh both = Join(outer, inner);
  ASSERT_OK_AND_ASSIGN(const RayScene scene, RayScene::Create(both));
  const auto t = scene.FindExit({0.01F, 0.02F, -0.99F}, {0, 0, 1}, 1e-3F);
  ASSERT_TRUE(t.has_value());
  EXPECT_NEAR(*t, 0.99 + 0.4, 0.01);
  const auto from_centre =
      scene.FindExit({0.01F, 0.02F, 0.5F}, {0, 0, 1}, 1e-3F);
  ASSERT_TRUE(from_centre.has_value());
  EXPECT_NEAR(*from_centre, 0.5, 0.01);
  EXPECT_FALSE(scene.FindExit({0, 0, 1.5F}, {0, 0, 1}, 1e-3F).has_value());
  // From outside only the far side counts.
  const auto from_outside = scene.FindExit({0.9F, 0.02F, 3}, {0, 0, -1}, 1e-3F);
  ASSERT_TRUE(from_outside.has_value());
  EXPECT_GT(*from_outside, 3);
}

TEST(ComputeShapeDiameter, FillsVerticesThatNoRayHitsFromTheirNeighbours) {
  // A tube with a long skirt at its end: the skirt flares so much that its
  // inward rays leave into the open.
  TriangleMesh mesh = MakeOpenCylinder(0.2, 2, 24, 40, true);
  for (int v = 35 * 24; v < mesh.num_vertices(); ++v) {
    const double z = mesh.V(v, 2);
    const double start = 2.0 * 34 / 39;
    mesh.V.row(v).head(2) *= 1 + 60 * (z - start);
    mesh.V(v, 2) = start;
  }
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd diameter,
                       Compute(mesh, {.smoothing_steps = 0}));
  EXPECT_GT(diameter.minCoeff(), 0);
  // The rim has the same value as what it was filled from.
  const double tube = diameter.segment(20 * 24, 24).mean();
  EXPECT_LT(diameter.tail(24).maxCoeff(), 4 * tube);
}

TEST(ComputeShapeDiameter, OfAFlatSheetIsATenthOfItsSize) {
  const TriangleMesh mesh = MakeGrid(3, 6, 1);
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd diameter, Compute(mesh));
  for (const double d : diameter) EXPECT_NEAR(d, 0.3, 1e-9);
}

TEST(ComputeShapeDiameter, SmoothsTowardsTheNeighbours) {
  const TriangleMesh mesh = MakeBox({1, 1, 0.2}, 0.1);
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd raw,
                       Compute(mesh, {.smoothing_steps = 0}));
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd smooth,
                       Compute(mesh, {.smoothing_steps = 5}));
  EXPECT_LT(smooth.maxCoeff() - smooth.minCoeff(),
            0.9 * (raw.maxCoeff() - raw.minCoeff()));
}

TEST(ComputeShapeDiameter, RepeatsBitForBit) {
  const TriangleMesh mesh = MakeTorus(1, 0.3, 40, 20);
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd a, Compute(mesh));
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd b, Compute(mesh));
  EXPECT_EQ(a, b);
}

TEST(ComputeShapeDiameter, TurnsAndScalesWithTheMesh) {
  // No two edges at a vertex are equally long, so the rays turn along.
  const TriangleMesh mesh = MakeIrregularSphere(10, 1, 42);
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd a, Compute(mesh));
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd b,
                       Compute(Moved(mesh, RandomRotation(43), 3, {1, 1, 1})));
  EXPECT_LT((b / 3 - a).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(ComputeShapeDiameter, RefusesOptionsOutsideTheirRange) {
  const TriangleMesh mesh = MakeIcosphere(2, 1);
  struct Row {
    ShapeDiameterOptions options;
    const char* message;
  };
  for (const Row& row :
       {Row{{.num_rays = 2}, "2 rays"}, Row{{.num_rays = 1001}, "1001 rays"},
        Row{{.cone_half_angle = 0.5}, "0.5 degrees"},
        Row{{.cone_half_angle = 90}, "90 degrees"},
        Row{{.cone_half_angle = std::nan("")}, "nan"},
        Row{{.smoothing_steps = -1}, "-1 smoothing"}}) {
    EXPECT_THAT(
        Compute(mesh, row.options),
        StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr(row.message)));
  }
}

TEST(ComputeShapeDiameter, RefusesASurfaceWithoutArea) {
  TriangleMesh mesh;
  mesh.V = VertexMatrix::Ones(3, 3);
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  EXPECT_THAT(Compute(mesh), StatusIs(absl::StatusCode::kFailedPrecondition,
                                      HasSubstr("area")));
  EXPECT_THAT(
      Compute(TriangleMesh()),
      StatusIs(absl::StatusCode::kFailedPrecondition, HasSubstr("area")));
}

}  // namespace
}  // namespace argmesh
