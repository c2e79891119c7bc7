#include "server/rpc/unread_answers.h"

#include <gtest/gtest.h>

namespace argmesh {
namespace {

struct CutCall : LiveCall {
  void OnNotTaken() override { ++cuts; }
  int cuts = 0;
};

TEST(UnreadAnswers, CutsNothingWithinTheBound) {
  UnreadAnswers unread(100);
  CutCall a;
  CutCall b;
  unread.Add(&a, "peer", 60);
  unread.Add(&b, "peer", 40);
  EXPECT_EQ(unread.bytes(), 100);
  unread.Remove(&a);
  EXPECT_EQ(unread.bytes(), 40);
  unread.Remove(&b);
  EXPECT_EQ(unread.bytes(), 0);
  EXPECT_EQ(a.cuts + b.cuts, 0);
}

TEST(UnreadAnswers, CutsTheOldestOfTheConnectionThatHoldsTheMost) {
  UnreadAnswers unread(100);
  CutCall other;
  CutCall first;
  CutCall second;
  CutCall third;
  unread.Add(&other, "small", 20);
  unread.Add(&first, "large", 40);
  unread.Add(&second, "large", 40);
  unread.Add(&third, "new", 30);
  EXPECT_EQ(first.cuts, 1);
  EXPECT_EQ(other.cuts + second.cuts + third.cuts, 0);
  EXPECT_EQ(unread.bytes(), 90);
  EXPECT_EQ(unread.cut(), 1);
}

TEST(UnreadAnswers, CutsAsManyAsItTakesAndEachOnce) {
  UnreadAnswers unread(100);
  CutCall small[10];
  for (CutCall& call : small) unread.Add(&call, "peer", 10);
  CutCall large;
  unread.Add(&large, "other", 95);
  // 100 against 95, then 90 against 95.
  EXPECT_EQ(small[0].cuts, 1);
  EXPECT_EQ(small[1].cuts, 0);
  EXPECT_EQ(large.cuts, 1);
  EXPECT_EQ(unread.bytes(), 90);
  for (CutCall& call : small) unread.Remove(&call);
  unread.Remove(&large);
  unread.Remove(&large);
  EXPECT_EQ(unread.bytes(), 0);
}

TEST(UnreadAnswers, CutsAnAnswerThatIsLargerThanTheBound) {
  UnreadAnswers unread(100);
  CutCall call;
  unread.Add(&call, "peer", 101);
  EXPECT_EQ(call.cuts, 1);
  EXPECT_EQ(unread.bytes(), 0);
}

TEST(UnreadAnswers, ForgetsACallThatIsDone) {
  UnreadAnswers unread(100);
  CutCall done;
  unread.Add(&done, "peer", 90);
  unread.Remove(&done);
  CutCall next;
  unread.Add(&next, "peer", 90);
  EXPECT_EQ(done.cuts + next.cuts, 0);
}

}  // namespace
}  // namespace argmesh
