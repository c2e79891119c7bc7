#include "core/signature/diagonal_mixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/signature/mixture_fit.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

// Two clouds at x = -4 and 4, deviations 1 in x and 0.5 in y.
PointRows MakeClouds(int count, uint64_t seed) {
  Random random(seed);
  PointRows points(count, 2);
  for (int i = 0; i < count; ++i) {
    points(i, 0) =
        static_cast<float>(random.Normal() + (i % 4 == 0 ? -4.0 : 4.0));
    points(i, 1) = static_cast<float>(0.5 * random.Normal());
  }
  return points;
}

TEST(FitDiagonalMixture, FindsTheClouds) {
  MixtureFitOptions options;
  options.components = 2;
  ASSERT_OK_AND_ASSIGN(const DiagonalMixture mixture,
                       FitDiagonalMixture(MakeClouds(4000, 1), options));
  const Eigen::Index left = mixture.means(0, 0) < 0 ? 0 : 1;
  EXPECT_NEAR(mixture.weights[left], 0.25, 0.02);
  EXPECT_NEAR(mixture.means(left, 0), -4, 0.15);
  EXPECT_NEAR(mixture.means(1 - left, 0), 4, 0.1);
  EXPECT_NEAR(mixture.variances(left, 0), 1, 0.15);
  EXPECT_NEAR(mixture.variances(left, 1), 0.25, 0.05);
}

TEST(FitDiagonalMixture, RepeatsToTheBitAndNamesTooFewPoints) {
  MixtureFitOptions options;
  options.components = 4;
  ASSERT_OK_AND_ASSIGN(const DiagonalMixture a,
                       FitDiagonalMixture(MakeClouds(200, 1), options));
  ASSERT_OK_AND_ASSIGN(const DiagonalMixture b,
                       FitDiagonalMixture(MakeClouds(200, 1), options));
  EXPECT_EQ(a.means, b.means);
  EXPECT_EQ(a.variances, b.variances);
  EXPECT_THAT(FitDiagonalMixture(MakeClouds(3, 1), options),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("4 components for 3 points")));
}

TEST(FitPrincipalAxes, FindsTheWidestDirectionFirst) {
  ASSERT_OK_AND_ASSIGN(const PrincipalAxes axes,
                       FitPrincipalAxes(MakeClouds(2000, 1), 2));
  EXPECT_NEAR(axes.axes(0, 0), 1, 0.01);
  EXPECT_GT(axes.variances[0], 10);
  EXPECT_NEAR(axes.variances[1], 0.25, 0.05);
  EXPECT_THAT(FitPrincipalAxes(MakeClouds(10, 1), 3),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("3 axes of 10 points in 2 dimensions")));
}

TEST(ComputePosteriors, ShareEachPointOut) {
  MixtureFitOptions options;
  options.components = 2;
  const PointRows points = MakeClouds(400, 1);
  ASSERT_OK_AND_ASSIGN(const DiagonalMixture mixture,
                       FitDiagonalMixture(points, options));
  const PointRows posteriors = ComputePosteriors(mixture, points);
  const Eigen::Index left = mixture.means(0, 0) < 0 ? 0 : 1;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    EXPECT_NEAR(posteriors.row(i).sum(), 1, 1e-5);
    if (points(i, 0) < -3) {
      EXPECT_GT(posteriors(i, left), 0.99);
    }
  }
}

TEST(EncodeFisherVector, SaysWhereThePointsDiffer) {
  MixtureFitOptions options;
  options.components = 2;
  ASSERT_OK_AND_ASSIGN(const DiagonalMixture mixture,
                       FitDiagonalMixture(MakeClouds(4000, 1), options));
  PointRows moved = MakeClouds(4000, 2);
  moved.col(1).array() += 1;
  const Eigen::VectorXf vector = EncodeFisherVector(mixture, moved);
  ASSERT_EQ(vector.size(), 2 * (1 + 2 * 2));
  EXPECT_NEAR(vector.norm(), 1, 1e-5);
  // Means in y, of both components.
  EXPECT_GT(vector[2 + 1], 0.3);
  EXPECT_GT(vector[2 + 3], 0.3);
  EXPECT_LT(std::abs(vector[2 + 0]), 0.3);
}

TEST(EncodeFisherVector, DoesNotCountPointsAndTakesNone) {
  MixtureFitOptions options;
  options.components = 2;
  ASSERT_OK_AND_ASSIGN(const DiagonalMixture mixture,
                       FitDiagonalMixture(MakeClouds(400, 1), options));
  const PointRows points = MakeClouds(100, 3);
  PointRows twice(200, 2);
  twice << points, points;
  EXPECT_TRUE(EncodeFisherVector(mixture, points)
                  .isApprox(EncodeFisherVector(mixture, twice), 1e-3F));
  EXPECT_EQ(EncodeFisherVector(mixture, PointRows(0, 2)).norm(), 0);
}

}  // namespace
}  // namespace argmesh
