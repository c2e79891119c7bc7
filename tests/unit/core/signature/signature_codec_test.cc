#include "core/signature/signature_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/base/random.h"
#include "core/base/sealed_bytes.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/core/signature/random_signature.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

// The bytes behind a fresh seal, so that only what they say is wrong.
std::string Resealed(const std::string& bytes) {
  return SealBytes("ARGS", kSignatureVersion, bytes.substr(kSealBytes));
}

TEST(SignatureCodec, GivesTheSignatureBackToTheBit) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const ShapeSignature signature = MakeRandomSignature(seed);
    const std::string bytes = EncodeSignature(signature);
    EXPECT_EQ(bytes.size(),
              kSealBytes + 1 + 4 * kChiralDims + 2 * size_t{kSignatureDims});
    ASSERT_OK_AND_ASSIGN(const ShapeSignature decoded, DecodeSignature(bytes));
    EXPECT_EQ(decoded, signature);
  }
}

TEST(SignatureCodec, RefusesEveryTruncationAndBytesTooMany) {
  const std::string bytes = EncodeSignature(MakeRandomSignature(1));
  for (size_t size = 0; size < bytes.size(); size += 7) {
    EXPECT_THAT(DecodeSignature(bytes.substr(0, size)),
                StatusIs(absl::StatusCode::kDataLoss, HasSubstr("signature")));
    if (size < kSealBytes) continue;
    EXPECT_THAT(DecodeSignature(Resealed(bytes.substr(0, size))),
                StatusIs(absl::StatusCode::kDataLoss, HasSubstr("signature")));
  }
  EXPECT_THAT(DecodeSignature(Resealed(bytes + "x")),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("signature")));
}

TEST(SignatureCodec, NoticesDamage) {
  const std::string bytes = EncodeSignature(MakeRandomSignature(1));
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = bytes;
    char& byte = damaged[random.Below(damaged.size())];
    byte = static_cast<char>(byte ^ (1 << random.Below(8)));
    EXPECT_THAT(DecodeSignature(damaged),
                StatusIs(absl::StatusCode::kDataLoss, HasSubstr("signature")));
  }
}

TEST(SignatureCodec, RefusesNumbersNoSignatureHas) {
  ShapeSignature signature = MakeRandomSignature(1);
  signature.point[3] = 2;
  EXPECT_THAT(DecodeSignature(EncodeSignature(signature)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("length")));
  signature = MakeRandomSignature(1);
  signature.view[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(DecodeSignature(EncodeSignature(signature)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("view")));
  signature = MakeRandomSignature(1);
  signature.chirality[7] = -1.5F;
  EXPECT_THAT(DecodeSignature(EncodeSignature(signature)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("chirality")));
  std::string bytes = EncodeSignature(MakeRandomSignature(1));
  bytes[kSealBytes] = 2;
  EXPECT_THAT(DecodeSignature(Resealed(bytes)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("smoothed")));
}

TEST(SignatureCodec, NamesAnotherVersion) {
  const std::string bytes = EncodeSignature(MakeRandomSignature(1));
  EXPECT_THAT(DecodeSignature(SealBytes("ARGS", kSignatureVersion + 1,
                                        bytes.substr(kSealBytes))),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("this program reads version")));
}

TEST(CheckShapeSignature, NamesAWrongSize) {
  ShapeSignature signature = MakeRandomSignature(1);
  EXPECT_THAT(CheckShapeSignature(signature), IsOk());
  signature.view.pop_back();
  EXPECT_THAT(CheckShapeSignature(signature),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("view has 1039 numbers, not 1040")));
}

}  // namespace
}  // namespace argmesh
