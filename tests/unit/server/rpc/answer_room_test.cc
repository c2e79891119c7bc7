#include "server/rpc/answer_room.h"

#include <gtest/gtest.h>

#include <string>

namespace argmesh {
namespace {

class AnswerRoomTest : public testing::Test {
 protected:
  struct Call : LiveCall {};

  // Says which of the calls are called when it is their turn.
  bool EnterOrWait(Call& call, const char* name, const char* peer = "peer") {
    return room_.EnterOrWait(
        &call, peer, [this, name] { called_ += std::string(name) + ' '; });
  }

  // `first_` and `second_`, for what `full_` holds.
  void LetTwoWait() {
    room_.Hold(&full_, "peer", 20);
    EXPECT_FALSE(EnterOrWait(first_, "first"));
    EXPECT_FALSE(EnterOrWait(second_, "second"));
  }

  AnswerRoom room_{20};
  Call full_;
  Call first_;
  Call second_;
  Call third_;
  std::string called_;
};

TEST_F(AnswerRoomTest, LetsAllInWhileThereIsRoom) {
  EXPECT_TRUE(room_.Enter(&first_, "peer"));
  room_.Hold(&first_, "peer", 19);
  EXPECT_TRUE(EnterOrWait(second_, "second"));
  room_.Hold(&second_, "peer", 1);
  EXPECT_FALSE(room_.Enter(&third_, "peer"));
  EXPECT_TRUE(room_.Enter(&third_, "another peer"));
  room_.Remove(&second_, "peer");
  EXPECT_TRUE(room_.Enter(&third_, "peer"));
  EXPECT_EQ(called_, "");
}

TEST_F(AnswerRoomTest, CallsThoseThatWaitInTheirOrder) {
  LetTwoWait();
  room_.Remove(&full_, "peer");
  EXPECT_EQ(called_, "first ");
  EXPECT_FALSE(EnterOrWait(third_, "third")) << "others wait";
  EXPECT_TRUE(EnterOrWait(first_, "first again"));
  room_.LetNextIn("peer");
  EXPECT_EQ(called_, "first second ");
  // One that is gone when it is its turn.
  room_.Remove(&second_, "peer");
  EXPECT_EQ(called_, "first second third ");
}

TEST_F(AnswerRoomTest, LetsOneThatWasCalledInVainWaitAsTheFirst) {
  LetTwoWait();
  room_.Remove(&full_, "peer");
  room_.Hold(&third_, "peer", 20);
  EXPECT_FALSE(EnterOrWait(first_, "first"));
  room_.LetNextIn("peer");
  EXPECT_EQ(called_, "first ") << "there is no room";
  room_.Remove(&third_, "peer");
  EXPECT_EQ(called_, "first first ");
}

TEST_F(AnswerRoomTest, CallsNobodyThatIsGone) {
  LetTwoWait();
  room_.Remove(&first_, "peer");
  EXPECT_EQ(called_, "");
  room_.Remove(&full_, "peer");
  EXPECT_EQ(called_, "second ");
  room_.Remove(&second_, "peer");
  room_.LetNextIn("peer");
  EXPECT_EQ(called_, "second ");
}

}  // namespace
}  // namespace argmesh
