#include "server/rpc/peer_budget.h"

#include <gtest/gtest.h>

#include <string>

namespace argmesh {
namespace {

struct CutCall : LiveCall {
  void OnOverBudget() override { ++cuts; }
  int cuts = 0;
};

TEST(PeerBudget, CutsNothingWithinTheBound) {
  PeerBudget budget(100);
  CutCall a;
  CutCall b;
  budget.Hold(&a, "peer", 60);
  budget.Hold(&b, "peer", 40);
  EXPECT_EQ(budget.bytes(), 100);
  budget.Remove(&a, "peer");
  EXPECT_EQ(budget.bytes(), 40);
  budget.Remove(&b, "peer");
  EXPECT_EQ(budget.bytes(), 0);
  EXPECT_EQ(a.cuts + b.cuts, 0);
}

TEST(PeerBudget, CutsTheOldestOfTheConnectionThatHoldsTheMost) {
  PeerBudget budget(100);
  CutCall other;
  CutCall first;
  CutCall second;
  CutCall third;
  budget.Hold(&other, "small", 20);
  budget.Hold(&first, "large", 40);
  budget.Hold(&second, "large", 40);
  budget.Hold(&third, "new", 30);
  EXPECT_EQ(first.cuts, 1);
  EXPECT_EQ(other.cuts + second.cuts + third.cuts, 0);
  EXPECT_EQ(budget.bytes(), 90);
  EXPECT_EQ(budget.cut(), 1);
}

TEST(PeerBudget, CutsAsManyAsItTakesAndEachOnce) {
  PeerBudget budget(100);
  CutCall small[10];
  for (CutCall& call : small) budget.Hold(&call, "peer", 10);
  CutCall large;
  budget.Hold(&large, "other", 95);
  // 100 against 95, then 90 against 95.
  EXPECT_EQ(small[0].cuts, 1);
  EXPECT_EQ(small[1].cuts, 0);
  EXPECT_EQ(large.cuts, 1);
  EXPECT_EQ(budget.bytes(), 90);
  for (CutCall& call : small) budget.Remove(&call, "peer");
  budget.Remove(&large, "peer");
  budget.Remove(&large, "peer");
  EXPECT_EQ(budget.bytes(), 0);
}

TEST(PeerBudget, CutsAnAnswerThatIsLargerThanTheBound) {
  PeerBudget budget(100);
  CutCall call;
  budget.Hold(&call, "peer", 101);
  EXPECT_EQ(call.cuts, 1);
  EXPECT_EQ(budget.bytes(), 0);
}

TEST(PeerBudget, ForgetsACallThatIsDone) {
  PeerBudget budget(100);
  CutCall done;
  budget.Hold(&done, "peer", 90);
  budget.Remove(&done, "peer");
  CutCall next;
  budget.Hold(&next, "peer", 90);
  EXPECT_EQ(done.cuts + next.cuts, 0);
}

TEST(PeerBudget, CountsWhatACallHoldsOnce) {
  PeerBudget budget(100);
  CutCall call;
  budget.Hold(&call, "peer", 60);
  budget.Hold(&call, "peer", 70);
  EXPECT_EQ(budget.bytes(), 70);
  EXPECT_EQ(call.cuts, 0);
}

TEST(PeerBudget, RunsWhatWaitsForRoomOneAtATime) {
  PeerBudget budget(100, 20);
  CutCall full;
  CutCall first;
  CutCall second;
  std::string ran;
  budget.Hold(&full, "peer", 20);
  EXPECT_FALSE(budget.HasRoom("peer"));
  EXPECT_TRUE(budget.AwaitRoom(&first, "peer", [&] { ran += "first "; }));
  EXPECT_TRUE(budget.AwaitRoom(&second, "peer", [&] { ran += "second "; }));
  CutCall other;
  EXPECT_TRUE(budget.HasRoom("other"));
  EXPECT_FALSE(budget.AwaitRoom(&other, "other", [&] { ran += "other "; }));
  budget.Remove(&other, "other");
  EXPECT_EQ(ran, "");
  budget.Remove(&full, "peer");
  EXPECT_EQ(ran, "first ");
  // It held nothing: there still is room.
  budget.Remove(&first, "peer");
  EXPECT_EQ(ran, "first second ");
}

TEST(PeerBudget, RunsNothingWithoutRoomOrForACallThatIsDone) {
  PeerBudget budget(100, 20);
  CutCall holders[2];
  CutCall gone;
  CutCall waits;
  std::string ran;
  for (CutCall& holder : holders) budget.Hold(&holder, "peer", 20);
  EXPECT_TRUE(budget.AwaitRoom(&gone, "peer", [&] { ran += "gone "; }));
  EXPECT_TRUE(budget.AwaitRoom(&waits, "peer", [&] { ran += "waits "; }));
  budget.Remove(&gone, "peer");
  budget.Remove(&holders[0], "peer");
  EXPECT_EQ(ran, "");
  budget.Remove(&holders[1], "peer");
  EXPECT_EQ(ran, "waits ");
}

}  // namespace
}  // namespace argmesh
