#include "core/evaluation/bootstrap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TEST(BootstrapMean, HasNoWidthForEqualValues) {
  const std::vector<double> values(20, 0.5);
  ASSERT_OK_AND_ASSIGN(const ConfidenceInterval interval,
                       BootstrapMean(values));
  EXPECT_EQ(interval.mean, 0.5);
  EXPECT_EQ(interval.low, 0.5);
  EXPECT_EQ(interval.high, 0.5);
}

TEST(BootstrapMean, IsAsWideAsTheNormalIntervalOfAMean) {
  Random random(4);
  std::vector<double> values(400);
  for (double& value : values) value = random.Normal();
  ASSERT_OK_AND_ASSIGN(const ConfidenceInterval interval,
                       BootstrapMean(values, {.resamples = 4000}));
  // 1.96 standard errors to both sides; the sample's deviation is about 1.
  EXPECT_NEAR(interval.high - interval.low, 2 * 1.96 / 20, 0.02);
  EXPECT_LT(interval.low, interval.mean);
  EXPECT_GT(interval.high, interval.mean);
}

TEST(BootstrapMean, RepeatsWithItsSeed) {
  Random random(5);
  std::vector<double> values(50);
  for (double& value : values) value = random.Uniform();
  ASSERT_OK_AND_ASSIGN(const auto first, BootstrapMean(values, {.seed = 7}));
  ASSERT_OK_AND_ASSIGN(const auto again, BootstrapMean(values, {.seed = 7}));
  ASSERT_OK_AND_ASSIGN(const auto other, BootstrapMean(values, {.seed = 8}));
  EXPECT_EQ(first.low, again.low);
  EXPECT_EQ(first.high, again.high);
  EXPECT_NE(first.low, other.low);
}

TEST(BootstrapMean, RefusesWhatHasNoMean) {
  EXPECT_THAT(BootstrapMean({}), StatusIs(absl::StatusCode::kInvalidArgument,
                                          HasSubstr("no values")));
  const std::vector<double> values = {1};
  EXPECT_THAT(
      BootstrapMean(values, {.resamples = 1}),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("1 resamples")));
  EXPECT_THAT(
      BootstrapMean(values, {.confidence = 1}),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("confidence 1")));
}

}  // namespace
}  // namespace argmesh
