#include "server/rpc/peer_pace.h"

#include <gtest/gtest.h>

namespace argmesh {
namespace {

const absl::Time kBegin = absl::FromUnixSeconds(1'700'000'000);

absl::Time After(int seconds) { return kBegin + absl::Seconds(seconds); }

TEST(PeerPace, LagsAsLongAsAPeerIsSilent) {
  PeerPace pace(kBegin);
  EXPECT_EQ(pace.Lag(After(10), true), absl::Seconds(10));
  EXPECT_EQ(pace.Lag(After(25), true), absl::Seconds(25));
}

TEST(PeerPace, CountsNoTimeInWhichThePeerIsNotWaitedFor) {
  PeerPace pace(kBegin);
  EXPECT_EQ(pace.Lag(After(100), false), absl::ZeroDuration());
  EXPECT_EQ(pace.Lag(After(101), true), absl::Seconds(1));
}

TEST(PeerPace, LagsOfAPeerThatTricklesToo) {
  PeerPace pace(kBegin);
  for (int second = 1; second <= 100; ++second) {
    pace.Lag(After(second), true);
    pace.Moved(1);
  }
  EXPECT_GT(pace.Lag(After(100), true), absl::Seconds(99));
}

TEST(PeerPace, FollowsAPeerThatSendsEnough) {
  PeerPace pace(kBegin);
  for (int second = 1; second <= 1000; ++second) {
    EXPECT_LE(pace.Lag(After(second), true), absl::Seconds(1));
    pace.Moved(kLeastBytesPerSecond);
  }
}

TEST(PeerPace, OwesAPeerNothingForWhatItSentBefore) {
  PeerPace pace(kBegin);
  pace.Moved(1 << 30);
  EXPECT_EQ(pace.Lag(After(60), true), absl::Seconds(60));
}

}  // namespace
}  // namespace argmesh
