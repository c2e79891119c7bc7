#include "core/base/utf8_prefix.h"

#include <gtest/gtest.h>

namespace argmesh {
namespace {

TEST(Utf8Prefix, IsTheWholeOfAShortText) {
  EXPECT_EQ(Utf8Prefix("", 3), "");
  EXPECT_EQ(Utf8Prefix("abc", 3), "abc");
  EXPECT_EQ(Utf8Prefix("a\xC3\xA9", 3), "a\xC3\xA9");
}

TEST(Utf8Prefix, NeverEndsWithinACharacter) {
  EXPECT_EQ(Utf8Prefix("abcd", 3), "abc");
  EXPECT_EQ(Utf8Prefix("a\xC3\xA9", 2), "a");
  EXPECT_EQ(Utf8Prefix("\xE2\x82\xAC\xE2\x82\xAC", 5), "\xE2\x82\xAC");
  EXPECT_EQ(Utf8Prefix("\xF0\x9F\x8D\xB5", 3), "");
}

}  // namespace
}  // namespace argmesh
