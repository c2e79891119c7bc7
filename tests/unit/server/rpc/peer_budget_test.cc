#include "server/rpc/peer_budget.h"

#include <gtest/gtest.h>

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
  budget.Remove(&a);
  EXPECT_EQ(budget.bytes(), 40);
  budget.Remove(&b);
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
  for (CutCall& call : small) budget.Remove(&call);
  budget.Remove(&large);
  budget.Remove(&large);
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
  budget.Remove(&done);
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

}  // namespace
}  // namespace argmesh
