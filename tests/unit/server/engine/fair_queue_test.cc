#include "server/engine/fair_queue.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace argmesh {
namespace {

const absl::Time kLate = absl::InfiniteFuture();

// Everything that waits, in its order; each work of "slow" takes 10 ms, others'
// 1 ms.
std::string Drain(FairQueue<std::string>& queue) {
  std::string order;
  while (!queue.empty()) {
    const auto next = queue.Pop();
    order += next.work;
    queue.Finished(next.caller,
                   absl::Milliseconds(next.caller == "slow" ? 10 : 1));
  }
  return order;
}

TEST(FairQueue, ServesOneCallerInTheOrderItCame) {
  FairQueue<std::string> queue;
  for (const char* work : {"1", "2", "3"}) queue.Push("a", kLate, work);
  EXPECT_EQ(Drain(queue), "123");
}

TEST(FairQueue, ServesCallersOfEqualWorkInTurn) {
  FairQueue<std::string> queue;
  for (const char* work : {"a", "a", "a"}) queue.Push("a", kLate, work);
  for (const char* work : {"b", "b"}) queue.Push("b", kLate, work);
  EXPECT_EQ(Drain(queue), "ababa");
}

TEST(FairQueue, ServesWhoTakesLittleTimeMoreOften) {
  FairQueue<std::string> queue;
  for (int i = 0; i < 4; ++i) queue.Push("slow", kLate, "s");
  for (int i = 0; i < 6; ++i) queue.Push("fast", kLate, "f");
  EXPECT_EQ(Drain(queue), "sfsfffffss");
}

TEST(FairQueue, ServesWhoComesNewBeforeWhoHasHadMuch) {
  FairQueue<std::string> queue;
  for (int i = 0; i < 100; ++i) queue.Push("slow", kLate, "s");
  for (int i = 0; i < 50; ++i) {
    queue.Finished(queue.Pop().caller, absl::Milliseconds(10));
  }
  queue.Push("new", kLate, "n");
  EXPECT_EQ(queue.Pop().caller, "new");
  // Nothing is saved up by asking for nothing.
  queue.Push("another", kLate, "o");
  queue.Push("another", kLate, "o");
  EXPECT_EQ(queue.Pop().caller, "another");
  EXPECT_EQ(queue.size(), 51U);
}

TEST(FairQueue, CountsNoWorkAsMoreThanAQuarterOfASecond) {
  FairQueue<std::string> queue;
  for (const char* work : {"1", "2", "3"}) queue.Push("long", kLate, work);
  queue.Pop();
  queue.Finished("long", absl::Hours(1));
  queue.Pop();
  // Work of 50 ms each, of another who comes again and again.
  int before = 0;
  queue.Push("short", kLate, "s");
  for (auto next = queue.Pop(); next.work == "s"; next = queue.Pop()) {
    queue.Push("short", kLate, "s");
    queue.Finished("short", absl::Milliseconds(50));
    ++before;
  }
  EXPECT_GE(before, 5);
  EXPECT_LE(before, 7);
}

TEST(FairQueue, TakesOutWhatHasGivenUp) {
  FairQueue<std::string> queue;
  const absl::Time now = absl::UnixEpoch();
  EXPECT_EQ(queue.FirstGiveUp(), absl::InfiniteFuture());
  queue.Push("a", now, "1");
  queue.Push("a", now + absl::Seconds(1), "2");
  queue.Push("b", now, "3");
  EXPECT_EQ(queue.FirstGiveUp(), now);
  EXPECT_EQ(queue.TakeLate(now), (std::vector<std::string>{"1", "3"}));
  EXPECT_EQ(queue.FirstGiveUp(), now + absl::Seconds(1));
  EXPECT_EQ(Drain(queue), "2");
}

TEST(FairQueue, PushesOutTheNewestOfWhoHasTheMost) {
  FairQueue<std::string> queue;
  std::string out;
  EXPECT_FALSE(queue.PushOut("a", out));
  for (const char* work : {"1", "2", "3"}) queue.Push("a", kLate, work);
  EXPECT_FALSE(queue.PushOut("a", out));
  ASSERT_TRUE(queue.PushOut("b", out));
  EXPECT_EQ(out, "3");
  queue.Push("b", kLate, "4");
  EXPECT_FALSE(queue.PushOut("b", out)) << "it would have as many";
  EXPECT_EQ(Drain(queue), "142");
}

}  // namespace
}  // namespace argmesh
