#include "server/rpc/key_quotas.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

const absl::Time kNow = absl::FromUnixSeconds(1'700'000'000);

KeyLimits Limits(double rate, int burst, int concurrent) {
  return {.requests_per_second = rate,
          .burst = burst,
          .concurrent_calls = concurrent};
}

TEST(KeyQuotas, LetsInABurstAndThenAsManyAsTheRate) {
  KeyQuotas quotas;
  const KeyLimits limits = Limits(2, 3, 0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(quotas.Admit("ci", limits, kNow).ok()) << i;
  }
  const auto refused = quotas.Admit("ci", limits, kNow);
  EXPECT_EQ(ReasonOf(refused.status()), ErrorReason::kKeyLimitExceeded);
  EXPECT_EQ(MetadataOf(refused.status()).at("limit"), "requests_per_second");
  EXPECT_EQ(MetadataOf(refused.status()).at("principal"), "ci");
  const absl::Duration wait = RetryDelayOf(refused.status()).value();
  EXPECT_EQ(wait, absl::Milliseconds(500));
  EXPECT_FALSE(
      quotas.Admit("ci", limits, kNow + wait - absl::Milliseconds(1)).ok());
  EXPECT_TRUE(quotas.Admit("ci", limits, kNow + wait).ok());
  EXPECT_FALSE(quotas.Admit("ci", limits, kNow + wait).ok());
}

TEST(KeyQuotas, NeverSavesMoreThanABurst) {
  KeyQuotas quotas;
  const KeyLimits limits = Limits(100, 2, 0);
  EXPECT_TRUE(quotas.Admit("ci", limits, kNow).ok());
  const absl::Time later = kNow + absl::Hours(1);
  EXPECT_TRUE(quotas.Admit("ci", limits, later).ok());
  EXPECT_TRUE(quotas.Admit("ci", limits, later).ok());
  EXPECT_FALSE(quotas.Admit("ci", limits, later).ok());
  // A clock that goes back gives nothing and takes nothing.
  EXPECT_FALSE(quotas.Admit("ci", limits, kNow).ok());
}

TEST(KeyQuotas, CountsCallsUntilTheyEnd) {
  KeyQuotas quotas;
  const KeyLimits limits = Limits(0, 0, 2);
  auto first = quotas.Admit("ci", limits, kNow);
  const auto second = quotas.Admit("ci", limits, kNow);
  ASSERT_TRUE(first.ok());
  ASSERT_TRUE(second.ok());
  const auto third = quotas.Admit("ci", limits, kNow);
  EXPECT_EQ(MetadataOf(third.status()).at("limit"), "concurrent_calls");
  EXPECT_EQ(MetadataOf(third.status()).at("value"), "2");
  EXPECT_TRUE(RetryDelayOf(third.status()).has_value());
  EXPECT_TRUE(quotas.Admit("other", limits, kNow).ok());
  first->reset();
  EXPECT_TRUE(quotas.Admit("ci", limits, kNow).ok());
}

TEST(KeyQuotas, FollowsLimitsThatChangeAndForgetsKeysThatWent) {
  KeyQuotas quotas;
  const auto held = quotas.Admit("ci", Limits(0, 0, 1), kNow);
  EXPECT_FALSE(quotas.Admit("ci", Limits(0, 0, 1), kNow).ok());
  EXPECT_TRUE(quotas.Admit("ci", Limits(0, 0, 2), kNow).ok());
  EXPECT_TRUE(quotas.Admit("ci", KeyLimits(), kNow).ok());
  quotas.KeepOnly({{"ci", ApiKey()}});
  EXPECT_FALSE(quotas.Admit("ci", Limits(0, 0, 1), kNow).ok());
  quotas.KeepOnly({});
  EXPECT_TRUE(quotas.Admit("ci", Limits(0, 0, 1), kNow).ok());
}

TEST(KeyQuotas, NeverLetsMoreInThanTheLimitFromManyThreads) {
  KeyQuotas quotas;
  std::atomic<int> inside{0};
  std::atomic<int> most{0};
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 2000; ++i) {
        const auto ticket = quotas.Admit("ci", Limits(0, 0, 2), kNow);
        if (!ticket.ok()) continue;
        const int now = ++inside;
        int seen = most;
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
        --inside;
      }
    });
  }
  threads.clear();
  EXPECT_GE(most, 1);
  EXPECT_LE(most, 2);
}

}  // namespace
}  // namespace argmesh
