#include "core/base/stop_token.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stop_token>

#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::_;

TEST(StopToken, NeverStopsWhenMadeByDefault) {
  const StopToken token;
  EXPECT_THAT(token.Check(), IsOk());
  EXPECT_EQ(token.deadline(), absl::InfiniteFuture());
}

TEST(StopToken, TellsEveryCopyThatItIsCancelled) {
  std::stop_source source;
  const StopToken token(source.get_token(), absl::InfiniteFuture());
  const StopToken copy = token;
  EXPECT_THAT(copy.Check(), IsOk());
  source.request_stop();
  EXPECT_THAT(token.Check(), StatusIs(absl::StatusCode::kCancelled, _));
  EXPECT_THAT(copy.Check(), StatusIs(absl::StatusCode::kCancelled, _));
}

TEST(StopToken, TellsThatTheDeadlineHasPassed) {
  const StopToken past({}, absl::Now() - absl::Milliseconds(1));
  EXPECT_THAT(past.Check(), StatusIs(absl::StatusCode::kDeadlineExceeded, _));
  const StopToken future({}, absl::Now() + absl::Hours(1));
  EXPECT_THAT(future.Check(), IsOk());
}

TEST(StopToken, KeepsTheEarlierOfTwoDeadlinesAndTheCancellation) {
  const absl::Time now = absl::Now();
  const absl::Time soon = now + absl::Hours(1);
  const absl::Time late = now + absl::Hours(2);
  std::stop_source source;
  const StopToken token(source.get_token(), soon);
  EXPECT_EQ(token.WithDeadline(late).deadline(), soon);
  const StopToken narrowed =
      StopToken(source.get_token(), late).WithDeadline(soon);
  EXPECT_EQ(narrowed.deadline(), soon);
  source.request_stop();
  EXPECT_THAT(narrowed.Check(), StatusIs(absl::StatusCode::kCancelled, _));
}

}  // namespace
}  // namespace argmesh
