#include "core/base/sealed_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TEST(SealedBytes, GiveThePayloadBack) {
  const std::string sealed = SealBytes("TEST", 3, "payload");
  EXPECT_EQ(sealed.size(), kSealBytes + 7);
  ASSERT_OK_AND_ASSIGN(const auto payload,
                       OpenSealedBytes("thing", "TEST", 3, sealed));
  EXPECT_EQ(payload, "payload");
}

TEST(SealedBytes, NameTheVersionThatIsNotRead) {
  const std::string sealed = SealBytes("TEST", 4, "payload");
  EXPECT_THAT(OpenSealedBytes("thing", "TEST", 3, sealed),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("thing: version 4, this program reads")));
}

TEST(SealedBytes, RefuseAnotherMagicBytesMissingAndBytesTooMany) {
  const std::string sealed = SealBytes("TEST", 3, "payload");
  EXPECT_THAT(OpenSealedBytes("thing", "REST", 3, sealed),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("magic")));
  EXPECT_THAT(OpenSealedBytes("thing", "TEST", 3, sealed.substr(0, 26)),
              StatusIs(absl::StatusCode::kDataLoss,
                       HasSubstr("7 bytes announced, 6 there")));
  EXPECT_THAT(OpenSealedBytes("thing", "TEST", 3, sealed + "x"),
              StatusIs(absl::StatusCode::kDataLoss,
                       HasSubstr("7 bytes announced, 8 there")));
}

TEST(SealedBytes, NoticeEveryBitOfDamage) {
  const std::string sealed = SealBytes("TEST", 3, "payload");
  for (size_t bit = 0; bit < sealed.size() * 8; ++bit) {
    std::string damaged = sealed;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_THAT(OpenSealedBytes("thing", "TEST", 3, damaged),
                StatusIs(absl::StatusCode::kDataLoss, HasSubstr("thing")))
        << "bit " << bit;
  }
}

}  // namespace
}  // namespace argmesh
