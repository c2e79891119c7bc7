#include "core/containment/window_extraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/containment/query_windows.h"
#include "core/containment/target_windows.h"
#include "core/containment/window_codebook.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using ::testing::_;

TEST(Windows, OfAMovedShapeAreTheSameWithinRounding) {
  const TriangleMesh mesh = MakeDumbbell();
  ASSERT_OK_AND_ASSIGN(const RawWindowSet a, ExtractRawWindows(mesh, {}));
  TriangleMesh moved = mesh;
  moved.V = (3.7 * mesh.V).rowwise() + Eigen::RowVector3d(5, -2, 9);
  ASSERT_OK_AND_ASSIGN(const RawWindowSet b, ExtractRawWindows(moved, {}));
  ASSERT_EQ(a.levels.size(), b.levels.size());
  for (size_t l = 0; l < a.levels.size(); ++l) {
    ASSERT_FALSE(a.levels[l].windows.empty());
    const RawDescriptor difference =
        a.levels[l].windows[0].raw - b.levels[l].windows[0].raw;
    EXPECT_LT(difference.norm(), 0.02F);
  }
  EXPECT_NEAR(b.frame.scale * 3.7, a.frame.scale, 1e-9);
}

TEST(Windows, FlipOfADescriptorIsThatOfTheFlippedSurface) {
  const TriangleMesh mesh = MakeTorus(1, 0.4, 60, 30);
  const Eigen::Vector3f position(1.4F, 0, 0);
  SampleLayer layer;
  SurfaceSamples samples =
      SampleSurface(mesh, Eigen::VectorXd::Ones(mesh.num_faces()), 4000, 1);
  layer.tree = PointTree(samples.positions);
  for (const int32_t number : layer.tree.numbers()) {
    layer.normals.push_back(samples.normals[static_cast<size_t>(number)]);
  }
  SampleLayer turned = layer;
  for (Eigen::Vector3f& normal : turned.normals) normal = -normal;
  const DescribedWindow out =
      DescribeWindow(layer, position, Eigen::Vector3f::UnitX(), 0.5F);
  const DescribedWindow in =
      DescribeWindow(turned, position, -Eigen::Vector3f::UnitX(), 0.5F);
  EXPECT_GT((out.raw - in.raw).norm(), 0.1F);
  EXPECT_LT((FlipDescriptor(out.raw) - in.raw).norm(), 1e-4F);
}

TEST(Windows, OfAQueryKeepAwayFromItsBoundary) {
  ASSERT_OK_AND_ASSIGN(const QueryWindows query,
                       ExtractQueryWindows(MakeSheet(30)));
  float radius = static_cast<float>(kFirstQueryRadius);
  for (const QueryLevel& level : query.levels) {
    for (const QueryWindow& window : level.windows) {
      const float to_border =
          0.5F - window.position.head<2>().lpNorm<Eigen::Infinity>();
      EXPECT_GE(to_border, 0.79F * radius);
    }
    radius *= std::sqrt(2.0F);
  }
  EXPECT_FALSE(query.levels[0].windows.empty());
  EXPECT_LT(query.levels[6].accepted, query.levels[0].accepted);
}

TEST(Windows, AreTheSameBitsEveryTime) {
  const TriangleMesh mesh = MakeDumbbell();
  ASSERT_OK_AND_ASSIGN(const TargetWindows a, ExtractTargetWindows(mesh));
  ASSERT_OK_AND_ASSIGN(const TargetWindows b, ExtractTargetWindows(mesh));
  EXPECT_EQ(a.points, b.points);
  for (size_t l = 0; l < a.levels.size(); ++l) {
    EXPECT_EQ(a.levels[l].frames, b.levels[l].frames);
    EXPECT_EQ(a.levels[l].descriptors, b.levels[l].descriptors);
  }
}

TEST(Windows, NeedASurface) {
  TriangleMesh flat;
  flat.V = VertexMatrix::Zero(3, 3);
  flat.F.resize(1, 3);
  flat.F << 0, 1, 2;
  EXPECT_THAT(ExtractTargetWindows(flat),
              StatusIs(absl::StatusCode::kFailedPrecondition, _));
  EXPECT_THAT(ExtractQueryWindows(flat),
              StatusIs(absl::StatusCode::kFailedPrecondition, _));
}

TEST(Windows, RefuseOptionsOutOfRange) {
  EXPECT_THAT(ExtractTargetWindows(MakeSheet(2), {.level_cap = 9}),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       ::testing::HasSubstr("level_cap is 9")));
  EXPECT_THAT(ExtractQueryWindows(MakeSheet(2), {.num_points = 1}),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       ::testing::HasSubstr("num_points is 1")));
}

}  // namespace
}  // namespace argmesh
