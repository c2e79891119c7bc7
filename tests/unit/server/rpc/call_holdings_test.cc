#include "server/rpc/call_holdings.h"

#include <gtest/gtest.h>

#include <string>

namespace argmesh {
namespace {

class CallHoldingsTest : public testing::Test {
 protected:
  PeerBudget budget_{100};
  AnswerRoom room_{10};
  LiveCall call_;
  LiveCall other_call_;
  const std::string peer_ = "peer";
  CallHoldings holdings_{&call_, peer_, room_};
  CallHoldings other_{&other_call_, peer_, room_};
  int called_ = 0;
};

TEST_F(CallHoldingsTest, AreGoneWhenTheCallIsDone) {
  holdings_.Hold(budget_, 60);
  holdings_.HoldRoom(10);
  EXPECT_FALSE(other_.EnterRoom());
  EXPECT_FALSE(other_.EnterRoomOrWait([this] { ++called_; }));
  holdings_.Close();
  EXPECT_EQ(budget_.bytes(), 0);
  EXPECT_EQ(called_, 1);
  EXPECT_TRUE(other_.EnterRoom());
}

TEST_F(CallHoldingsTest, AreNotTakenAnyMoreOnceTheCallIsDone) {
  holdings_.Close();
  holdings_.Hold(budget_, 60);
  holdings_.HoldRoom(10);
  EXPECT_EQ(budget_.bytes(), 0);
  EXPECT_TRUE(other_.EnterRoom());
  EXPECT_FALSE(holdings_.EnterRoomOrWait([this] { ++called_; }));
  other_.Close();
  EXPECT_EQ(called_, 0);
}

TEST_F(CallHoldingsTest, AreLetGoOneBudgetAtATime) {
  holdings_.Hold(budget_, 60);
  holdings_.LetGo(budget_);
  EXPECT_EQ(budget_.bytes(), 0);
  holdings_.Hold(budget_, 70);
  EXPECT_EQ(budget_.bytes(), 70);
}

}  // namespace
}  // namespace argmesh
