#include "server/engine/fair_queue.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace argmesh {
namespace {

const absl::Time kLate = absl::InfiniteFuture();

// Everything that waits, in its order.
std::string Drain(FairQueue<std::string>& queue) {
  std::string order;
  while (!queue.empty()) order += queue.Pop();
  return order;
}

TEST(FairQueue, ServesOneCallerInTheOrderItCame) {
  FairQueue<std::string> queue;
  for (const char* work : {"1", "2", "3"}) queue.Push("a", kLate, work);
  EXPECT_EQ(Drain(queue), "123");
}

TEST(FairQueue, ServesCallersInTurn) {
  FairQueue<std::string> queue;
  for (const char* work : {"a", "a", "a"}) queue.Push("a", kLate, work);
  for (const char* work : {"b", "b"}) queue.Push("b", kLate, work);
  EXPECT_EQ(queue.Pop(), "a");
  queue.Push("c", kLate, "c");
  EXPECT_EQ(Drain(queue), "bacba");
}

TEST(FairQueue, MakesNobodyWaitForThoseWhoComeLater) {
  FairQueue<std::string> queue;
  queue.Push("old", kLate, "o");
  queue.Push("old", kLate, "o");
  int old = 0;
  for (int others = 0; old < 2; ++others) {
    ASSERT_LT(others, 4);
    queue.Push("new" + std::to_string(others), kLate, "n");
    if (queue.Pop() == "o") ++old;
  }
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
