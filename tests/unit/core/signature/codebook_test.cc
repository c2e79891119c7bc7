#include "core/signature/codebook.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/sealed_bytes.h"
#include "core/signature/signature_codec.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TEST(DefaultCodebook, IsWholeAndSmall) {
  ASSERT_OK_AND_ASSIGN(const Codebook* codebook, DefaultCodebook());
  EXPECT_NEAR(codebook->points.weights.sum(), 1, 1e-3);
  EXPECT_NEAR(codebook->patches.weights.sum(), 1, 1e-3);
  EXPECT_LT(EncodeCodebook(*codebook).size(), 300'000U);
}

TEST(Codebook, SurvivesItsBytes) {
  ASSERT_OK_AND_ASSIGN(const Codebook* codebook, DefaultCodebook());
  const std::string bytes = EncodeCodebook(*codebook);
  ASSERT_OK_AND_ASSIGN(const Codebook decoded, DecodeCodebook(bytes));
  EXPECT_EQ(EncodeCodebook(decoded), bytes);
}

TEST(Codebook, RefusesDamageAndAnotherVersion) {
  ASSERT_OK_AND_ASSIGN(const Codebook* codebook, DefaultCodebook());
  const std::string bytes = EncodeCodebook(*codebook);
  EXPECT_THAT(DecodeCodebook(bytes.substr(0, 1000)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("codebook")));
  const std::string payload = bytes.substr(kSealBytes);
  EXPECT_THAT(
      DecodeCodebook(SealBytes("ARGC", kSignatureVersion + 1, payload)),
      StatusIs(absl::StatusCode::kFailedPrecondition, HasSubstr("version")));
  EXPECT_THAT(DecodeCodebook(SealBytes("ARGC", kSignatureVersion,
                                       payload.substr(0, 5000))),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("codebook")));
  EXPECT_THAT(
      DecodeCodebook(SealBytes("ARGC", kSignatureVersion, payload + "x")),
      StatusIs(absl::StatusCode::kDataLoss, HasSubstr("codebook")));
}

TEST(Codebook, RefusesNumbersNoCodebookHas) {
  ASSERT_OK_AND_ASSIGN(const Codebook* good, DefaultCodebook());
  Codebook bad = *good;
  bad.points.weights[3] = 0;
  EXPECT_THAT(DecodeCodebook(EncodeCodebook(bad)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("positive")));
  bad = *good;
  bad.field_knots(2, 10) = bad.field_knots(2, 9) - 1;
  EXPECT_THAT(DecodeCodebook(EncodeCodebook(bad)),
              StatusIs(absl::StatusCode::kDataLoss,
                       HasSubstr("knots of quantity 2 descend at 10")));
}

TEST(FieldScore, InterpolatesBetweenKnots) {
  Codebook codebook;
  codebook.field_knots.resize(kNumFields, kFieldKnots);
  for (int k = 0; k < kFieldKnots; ++k) {
    codebook.field_knots.col(k).setConstant(static_cast<float>(k));
  }
  // A run of equal knots: a value that many points have.
  for (int k = 10; k <= 20; ++k) codebook.field_knots(1, k) = 10;
  constexpr float kMiddle = (kFieldKnots - 1) / 2.0F;
  EXPECT_NEAR(FieldScore(codebook, 0, kMiddle), 0, 1e-6);
  EXPECT_FLOAT_EQ(FieldScore(codebook, 0, -5), -kMaxScore);
  EXPECT_FLOAT_EQ(FieldScore(codebook, 0, 1e6F), kMaxScore);
  EXPECT_NEAR(FieldScore(codebook, 0, kMiddle + 0.5F),
              kMaxScore / (kFieldKnots - 1), 1e-6);
  EXPECT_FLOAT_EQ(FieldScore(codebook, 1, 10), FieldScore(codebook, 0, 15));
}

}  // namespace
}  // namespace argmesh
