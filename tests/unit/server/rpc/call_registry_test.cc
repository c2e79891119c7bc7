#include "server/rpc/call_registry.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "absl/time/clock.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

struct CountingCall : LiveCall {
  void OnTick(absl::Time) override { ++ticks; }
  void OnDrain(absl::Duration grace) override {
    ++drains;
    last_grace = grace;
  }
  std::atomic<int> ticks{0};
  std::atomic<int> drains{0};
  absl::Duration last_grace;
};

TEST(CallRegistry, CountsCallsAndTicksThem) {
  CallRegistry registry(absl::Milliseconds(1));
  CountingCall call;
  EXPECT_TRUE(registry.Enter(&call).ok());
  EXPECT_EQ(registry.in_flight(), 1);
  while (call.ticks < 3) std::this_thread::yield();
  registry.Leave(&call);
  EXPECT_EQ(registry.in_flight(), 0);
  const int ticks = call.ticks;
  CountingCall other;
  EXPECT_TRUE(registry.Enter(&other).ok());
  while (other.ticks < 3) std::this_thread::yield();
  EXPECT_EQ(call.ticks, ticks);
  registry.Leave(&other);
}

TEST(CallRegistry, TellsCallsOnceThatItDrainsAndRefusesLaterOnes) {
  CallRegistry registry;
  CountingCall call;
  ASSERT_TRUE(registry.Enter(&call).ok());
  registry.StartDrain(absl::Seconds(7));
  registry.StartDrain(absl::Seconds(8));
  EXPECT_EQ(call.drains, 1);
  EXPECT_EQ(call.last_grace, absl::Seconds(7));
  EXPECT_TRUE(registry.draining());
  CountingCall late;
  const absl::Status refused = registry.Enter(&late);
  EXPECT_EQ(ReasonOf(refused), ErrorReason::kDraining);
  EXPECT_EQ(late.drains, 0);
  EXPECT_EQ(registry.in_flight(), 2);
  registry.Leave(&late);
  registry.Leave(&call);
}

TEST(CallRegistry, WaitsForTheLastCallOrTheDeadline) {
  CallRegistry registry;
  EXPECT_TRUE(registry.WaitUntilIdle(absl::Now()));
  CountingCall call;
  ASSERT_TRUE(registry.Enter(&call).ok());
  EXPECT_FALSE(registry.WaitUntilIdle(absl::Now() + absl::Milliseconds(5)));
  std::thread leaver([&] { registry.Leave(&call); });
  EXPECT_TRUE(registry.WaitUntilIdle(absl::InfiniteFuture()));
  leaver.join();
}

TEST(CallRegistry, WaitsForCallsThatAreHeldThoughTheyHaveLeft) {
  CallRegistry registry;
  CountingCall call;
  registry.Hold();
  ASSERT_TRUE(registry.Enter(&call).ok());
  registry.Leave(&call);
  EXPECT_EQ(registry.in_flight(), 0);
  EXPECT_FALSE(registry.WaitUntilIdle(absl::Now() + absl::Milliseconds(5)));
  std::thread releaser([&] { registry.Release(); });
  EXPECT_TRUE(registry.WaitUntilIdle(absl::InfiniteFuture()));
  releaser.join();
}

}  // namespace
}  // namespace argmesh
