#include "core/signature/point_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/signature/codebook.h"
#include "core/signature/signature_surface.h"
#include "core/signature/surface_points.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

PointRows FieldsOf(const TriangleMesh& mesh) {
  const auto surface = PrepareSurface(mesh);
  EXPECT_THAT(surface, IsOk());
  auto fields = MeasurePointFields(*surface);
  EXPECT_THAT(fields, IsOk());
  return *std::move(fields);
}

TriangleMesh MakeBall() {
  std::vector<Eigen::Vector2d> profile;
  for (int i = 1; i < 48; ++i) {
    const double angle = std::numbers::pi * i / 48;
    profile.emplace_back(-std::cos(angle), std::sin(angle));
  }
  return MakeRevolution(profile, 72);
}

TEST(MeasurePointFields, KnowsABall) {
  const PointRows fields = FieldsOf(MakeBall());
  ASSERT_EQ(fields.rows(), kDescribedPoints);
  ASSERT_EQ(fields.cols(), kNumFields);
  EXPECT_TRUE(fields.allFinite());
  const double radius = 1 / std::sqrt(4 * std::numbers::pi);
  const Eigen::RowVectorXf mean = fields.colwise().mean();
  // Curvatures are equal and positive, 1/radius in units of 1/0.1.
  EXPECT_GT(mean[kShapeIndexWide], 0.9F);
  EXPECT_NEAR(mean[kCurvednessWide], std::log(0.1 / radius + 0.02), 0.1);
  EXPECT_NEAR(mean[kAreaWide], 1, 0.05);
  EXPECT_LT(mean[kOffsetWide], -0.05F);
  EXPECT_NEAR(mean[kCentrality], radius, 0.01);
  EXPECT_EQ(mean[kOcclusion], 0);
  EXPECT_GT(mean[kThickness], radius);
  EXPECT_LT(mean[kThickness], 2 * radius);
  // A quarter of the circumference on average.
  EXPECT_NEAR(mean[kGeodesic], radius * std::numbers::pi / 2, 0.06);
}

TEST(MeasurePointFields, KnowsASheet) {
  const PointRows fields = FieldsOf(MakeSheet(10));
  const Eigen::RowVectorXf mean = fields.colwise().mean();
  EXPECT_NEAR(mean[kCurvednessNear], std::log(0.02), 0.05);
  EXPECT_NEAR(mean[kOffsetNear], 0, 1e-3);
  EXPECT_EQ(mean[kThickness], 0);
  EXPECT_EQ(mean[kOcclusion], 0);
  EXPECT_GT(mean[kGeodesic], 0.4F);
  EXPECT_LT(mean[kGeodesic], 0.75F);
}

TEST(MeasurePointFields, SeesTheInsideOfATorus) {
  const PointRows fields = FieldsOf(MakeTorus(1, 0.4, 64, 32));
  EXPECT_GT(fields.col(kOcclusion).maxCoeff(), 0.2F);
  EXPECT_EQ(fields.col(kOcclusion).minCoeff(), 0);
  // Saddles inside, caps outside.
  EXPECT_LT(fields.col(kShapeIndexWide).minCoeff(), 0.3F);
  EXPECT_GT(fields.col(kShapeIndexWide).maxCoeff(), 0.5F);
}

TEST(SpreadPoints, GivesEveryPartItsShare) {
  const TriangleMesh mesh = MakeSheet(3);
  ASSERT_OK_AND_ASSIGN(const SignatureSurface surface, PrepareSurface(mesh));
  const SurfacePoints points = SpreadPoints(surface);
  ASSERT_EQ(points.positions.size(), size_t{kSurfacePoints});
  // Any head is spread over the whole.
  for (const size_t head : {size_t{512}, size_t{kSurfacePoints}}) {
    size_t right = 0;
    for (size_t i = 0; i < head; ++i) {
      if (points.positions[i].x() > 0) ++right;
    }
    EXPECT_NEAR(static_cast<double>(right) / static_cast<double>(head), 0.5,
                0.08);
  }
}

}  // namespace
}  // namespace argmesh
