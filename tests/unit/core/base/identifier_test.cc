#include "core/base/identifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(IsIdentifier, HoldsTheRule) {
  for (const std::string& id :
       {std::string("a"), std::string("cup-21"), std::string(63, 'a')}) {
    EXPECT_TRUE(IsIdentifier(id)) << id;
  }
  for (const std::string& id :
       {std::string(), std::string("1a"), std::string("-a"), std::string("a-"),
        std::string("A"), std::string("a_b"), std::string("a/b"),
        std::string("a\0b", 3), std::string("\xC3\xA4"),
        std::string(64, 'a')}) {
    EXPECT_FALSE(IsIdentifier(id)) << id;
  }
}

TEST(CheckIdentifier, NamesTheThingTheIdAndTheRule) {
  EXPECT_THAT(CheckIdentifier("gallery", "cups"), IsOk());
  EXPECT_THAT(CheckIdentifier("gallery", "Cups!"),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("gallery id \"Cups!\": 1 to 63")));
}

TEST(CheckIdentifier, DoesNotRepeatAHugeIdInItsMessage) {
  const absl::Status status =
      CheckIdentifier("gallery", std::string(1'000'000, 'X'));
  EXPECT_LT(status.message().size(), 400U);
}

TEST(IdentifierFromPath, KeepsWhatIsAnIdentifierAlready) {
  EXPECT_EQ(IdentifierFromPath("cup-21-off"), "cup-21-off");
}

TEST(IdentifierFromPath, IsAnIdentifierForAnyPath) {
  for (const std::string& path :
       {std::string(), std::string("Cup/21.OFF"), std::string("21.off"),
        std::string("---"), std::string(300, 'x'), std::string("../../etc"),
        std::string("\xF0\x9F\x8D\xB5.obj"), std::string(62, 'a') + "-b"}) {
    EXPECT_TRUE(IsIdentifier(IdentifierFromPath(path)))
        << path << " gave " << IdentifierFromPath(path);
  }
}

TEST(IdentifierFromPath, IsReadableAndTellsSimilarPathsApart) {
  EXPECT_THAT(IdentifierFromPath("Cup/21.OFF"), StartsWith("cup-21-off-"));
  const std::set<std::string> ids = {
      IdentifierFromPath("Cup/21.OFF"), IdentifierFromPath("cup/21.off"),
      IdentifierFromPath("cup-21.off"), IdentifierFromPath("cup-21-off"),
      IdentifierFromPath("cup--21-off")};
  EXPECT_EQ(ids.size(), 5U);
}

TEST(IdentifierFromPath, GivesTheSameIdEveryTime) {
  EXPECT_EQ(IdentifierFromPath("a b.off"), IdentifierFromPath("a b.off"));
}

}  // namespace
}  // namespace argmesh
