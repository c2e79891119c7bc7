#include "core/base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace argmesh {
namespace {

TEST(Random, GivesTheKnownStreamOfSplitMix64) {
  // The reference implementation's first outputs for the seed 1234567.
  Random random(1234567);
  EXPECT_EQ(random.NextU64(), 6457827717110365317ULL);
  EXPECT_EQ(random.NextU64(), 3203168211198807973ULL);
  EXPECT_EQ(random.NextU64(), 9817491932198370423ULL);
}

TEST(Random, RepeatsForEqualSeedsAndDiffersForOthers) {
  Random a(7);
  Random b(7);
  Random c(8);
  int differing = 0;
  for (int i = 0; i < 100; ++i) {
    const uint64_t value = a.NextU64();
    EXPECT_EQ(value, b.NextU64());
    if (value != c.NextU64()) ++differing;
  }
  EXPECT_EQ(differing, 100);
}

TEST(Random, UniformStaysInItsRangeAndHasItsMoments) {
  constexpr int kCount = 100'000;
  Random random(1);
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.Uniform(-2, 4);
    ASSERT_GE(value, -2);
    ASSERT_LT(value, 4);
    sum += value;
    squares += value * value;
  }
  const double mean = sum / kCount;
  EXPECT_NEAR(mean, 1.0, 0.03);
  EXPECT_NEAR(squares / kCount - mean * mean, 3.0, 0.05);
}

TEST(Random, BelowGivesEveryValueAboutEquallyOften) {
  Random random(2);
  std::array<int, 7> counts = {};
  for (int i = 0; i < 70'000; ++i) {
    const uint64_t value = random.Below(counts.size());
    ASSERT_LT(value, counts.size());
    ++counts[value];
  }
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 500);
}

TEST(Random, NormalHasMeanZeroAndVarianceOne) {
  constexpr int kCount = 100'000;
  Random random(3);
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.Normal();
    ASSERT_TRUE(std::isfinite(value));
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.02);
  EXPECT_NEAR(squares / kCount, 1.0, 0.03);
}

}  // namespace
}  // namespace argmesh
