#include "core/base/crc32c.h"

#include <gtest/gtest.h>

#include <string>

namespace argmesh {
namespace {

TEST(ComputeCrc32c, GivesTheKnownAnswers) {
  EXPECT_EQ(ComputeCrc32c(""), 0U);
  EXPECT_EQ(ComputeCrc32c("123456789"), 0xE3069283U);
  // RFC 3720, B.4.
  EXPECT_EQ(ComputeCrc32c(std::string(32, '\0')), 0x8A9136AAU);
  EXPECT_EQ(ComputeCrc32c(std::string(32, '\xFF')), 0x62A8AB43U);
}

TEST(ComputeCrc32c, SeesEverySingleBitThatIsTurned) {
  const std::string text = "a hierarchy of attributed relational graphs";
  const uint32_t crc = ComputeCrc32c(text);
  for (size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string damaged = text;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NE(ComputeCrc32c(damaged), crc) << "bit " << bit;
  }
}

}  // namespace
}  // namespace argmesh
