#include "server/rpc/connection_calls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class ConnectionCallsTest : public ::testing::Test {
 protected:
  ConnectionCallsTest() {
    calls_.SetCut([this](const std::string& peer) { cut_.push_back(peer); });
  }
  void EnterAsManyAsThereMayBe(const std::string& peer) {
    for (int i = 0; i < ConnectionCalls::kMaxCalls; ++i) {
      EXPECT_TRUE(calls_.Enter(peer));
    }
  }

  std::vector<std::string> cut_;
  ConnectionCalls calls_;
};

TEST_F(ConnectionCallsTest, CutsAConnectionOnceThatHasTooManyUnderWay) {
  EnterAsManyAsThereMayBe("a");
  EXPECT_THAT(cut_, IsEmpty());
  EXPECT_FALSE(calls_.Enter("a"));
  EXPECT_FALSE(calls_.Enter("a"));
  EXPECT_THAT(cut_, ElementsAre("a"));
  EXPECT_TRUE(calls_.Enter("b")) << "another connection";
}

TEST_F(ConnectionCallsTest, CountsOnlyWhatIsUnderWay) {
  EnterAsManyAsThereMayBe("a");
  calls_.Leave("a");
  EXPECT_TRUE(calls_.Enter("a"));
  EXPECT_THAT(cut_, IsEmpty());
}

TEST_F(ConnectionCallsTest, ForgetsAConnectionWithoutCalls) {
  EnterAsManyAsThereMayBe("a");
  EXPECT_FALSE(calls_.Enter("a"));
  for (int i = 0; i <= ConnectionCalls::kMaxCalls; ++i) calls_.Leave("a");
  EnterAsManyAsThereMayBe("a");
}

}  // namespace
}  // namespace argmesh
