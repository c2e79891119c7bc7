#include "client/backoff.h"

#include <gtest/gtest.h>

namespace argmesh {
namespace {

constexpr RetryOptions kOptions = {.max_attempts = 4,
                                   .initial_backoff = absl::Milliseconds(100),
                                   .max_backoff = absl::Milliseconds(300),
                                   .multiplier = 2};

TEST(Backoff, GrowsUpToItsLargestWaitAndEndsAfterTheLastAttempt) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Backoff backoff(kOptions, seed);
    const absl::Status failure = absl::UnavailableError("x");
    for (const int full : {100, 200, 300}) {
      const auto wait = backoff.Next(failure);
      ASSERT_TRUE(wait.has_value());
      EXPECT_GE(*wait, absl::Milliseconds(full) / 2);
      EXPECT_LE(*wait, absl::Milliseconds(full));
    }
    EXPECT_FALSE(backoff.Next(failure).has_value());
    backoff.Reset();
    EXPECT_TRUE(backoff.Next(failure).has_value());
  }
}

TEST(Backoff, DoesNotRepeatWhatCannotSucceed) {
  Backoff backoff(kOptions, 1);
  EXPECT_FALSE(backoff.Next(absl::InvalidArgumentError("x")).has_value());
}

}  // namespace
}  // namespace argmesh
