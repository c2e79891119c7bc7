#include "core/evaluation/segmentation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TEST(RandIndexError, IsZeroWhateverTheLabelsAreCalled) {
  const std::vector<int32_t> labels = {0, 0, 1, 2};
  const std::vector<int32_t> renamed = {7, 7, -1, 3};
  const std::vector<double> areas = {1, 2, 3, 4};
  ASSERT_OK_AND_ASSIGN(const double error,
                       RandIndexError(labels, renamed, areas));
  EXPECT_NEAR(error, 0, 1e-12);
}

TEST(RandIndexError, EqualsTheCaseWorkedByHand) {
  // Whole surface against two parts of 1/4 and 3/4: the pairs of points in
  // different parts, 2 * 1/4 * 3/4.
  const std::vector<int32_t> whole = {0, 0};
  const std::vector<int32_t> parts = {0, 1};
  const std::vector<double> areas = {1, 3};
  ASSERT_OK_AND_ASSIGN(const double error, RandIndexError(whole, parts, areas));
  EXPECT_DOUBLE_EQ(error, 0.375);
}

TEST(RandIndexError, DoesNotDependOnTessellation) {
  // The second face of area 3 cut in three.
  const std::vector<int32_t> whole = {0, 0, 0, 0};
  const std::vector<int32_t> parts = {0, 1, 1, 1};
  const std::vector<double> areas = {1, 1, 1, 1};
  ASSERT_OK_AND_ASSIGN(const double error, RandIndexError(whole, parts, areas));
  EXPECT_DOUBLE_EQ(error, 0.375);
}

TEST(RandIndexError, EqualsCountingPairsOnRandomLabels) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const size_t n = 30;
    std::vector<int32_t> a(n), b(n);
    std::vector<double> areas(n);
    double total = 0;
    for (size_t i = 0; i < n; ++i) {
      a[i] = static_cast<int32_t>(random.Below(4));
      b[i] = static_cast<int32_t>(random.Below(3));
      areas[i] = random.Uniform();
      total += areas[i];
    }
    double expected = 0;
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = 0; j < n; ++j) {
        if ((a[i] == a[j]) != (b[i] == b[j])) expected += areas[i] * areas[j];
      }
    }
    expected /= total * total;
    ASSERT_OK_AND_ASSIGN(const double error, RandIndexError(a, b, areas));
    EXPECT_NEAR(error, expected, 1e-12) << seed;
    ASSERT_OK_AND_ASSIGN(const double swapped, RandIndexError(b, a, areas));
    EXPECT_NEAR(swapped, error, 1e-12) << seed;
  }
}

TEST(Repeatability, CountsTheAreaOfSegmentsThatAreFoundAgain) {
  // Segment 0 (area 4) keeps 3 of 4: found. Segment 1 (area 6) is split into
  // 1 + 2 + 3; its largest part overlaps by 3/6: found at 0.5, not above.
  const std::vector<int32_t> labels = {0, 0, 1, 1, 1};
  const std::vector<int32_t> other = {0, 1, 1, 2, 3};
  const std::vector<double> areas = {3, 1, 1, 2, 3};
  ASSERT_OK_AND_ASSIGN(const double half, Repeatability(labels, other, areas));
  EXPECT_DOUBLE_EQ(half, 1);
  ASSERT_OK_AND_ASSIGN(const double more,
                       Repeatability(labels, other, areas, 0.6));
  EXPECT_DOUBLE_EQ(more, 0.4);
  ASSERT_OK_AND_ASSIGN(const double all,
                       Repeatability(labels, labels, areas, 1.0));
  EXPECT_DOUBLE_EQ(all, 1);
}

TEST(Segmentation, RefusesWhatHasNoMeaning) {
  const std::vector<int32_t> two = {0, 1};
  const std::vector<int32_t> one = {0};
  const std::vector<double> areas = {1, 1};
  EXPECT_THAT(RandIndexError(two, one, areas),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("2 and 1 labels of 2 areas")));
  const std::vector<double> negative = {1, -1};
  EXPECT_THAT(RandIndexError(two, two, negative),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("element 1: area -1")));
  const std::vector<double> nothing = {0, 0};
  EXPECT_THAT(
      Repeatability(two, two, nothing),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("no area")));
}

}  // namespace
}  // namespace argmesh
