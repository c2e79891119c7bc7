#include "core/signature/compact_basis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/sealed_bytes.h"
#include "core/signature/signature_codec.h"
#include "core/signature/similarity_scale.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/core/signature/random_signature.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

// `classes` x `items` signatures, those of a class near each other.
std::vector<ShapeSignature> MakeClusters(int classes, int items) {
  std::vector<ShapeSignature> signatures;
  for (int c = 0; c < classes; ++c) {
    const ShapeSignature center = MakeRandomSignature(static_cast<uint64_t>(c));
    for (int i = 0; i < items; ++i) {
      signatures.push_back(PerturbSignature(
          center, 0.4F, static_cast<uint64_t>(1000 + c * items + i)));
    }
  }
  return signatures;
}

std::vector<const ShapeSignature*> Pointers(
    const std::vector<ShapeSignature>& signatures) {
  std::vector<const ShapeSignature*> pointers;
  for (const ShapeSignature& signature : signatures) {
    pointers.push_back(&signature);
  }
  return pointers;
}

TEST(CompactBasis, KeepsClassesTogether) {
  const std::vector<ShapeSignature> signatures = MakeClusters(6, 20);
  ASSERT_OK_AND_ASSIGN(const CompactBasis basis,
                       FitCompactBasis(Pointers(signatures)));
  EXPECT_EQ(basis.axes.cols(), kCompactDims);
  EXPECT_TRUE((basis.axes.transpose() * basis.axes).isIdentity(1e-3F));
  std::vector<CompactVector> vectors;
  for (const ShapeSignature& signature : signatures) {
    vectors.push_back(ProjectSignature(basis, signature));
  }
  double least_within = 1;
  double most_between = -1;
  for (size_t i = 0; i < vectors.size(); ++i) {
    EXPECT_DOUBLE_EQ(CompactSimilarity(vectors[i], vectors[i]), 1.0);
    for (size_t j = 0; j < i; ++j) {
      const double similarity = CompactSimilarity(vectors[i], vectors[j]);
      EXPECT_EQ(similarity, CompactSimilarity(vectors[j], vectors[i]));
      if (i / 20 == j / 20) {
        least_within = std::min(least_within, similarity);
      } else {
        most_between = std::max(most_between, similarity);
      }
    }
  }
  EXPECT_GT(least_within, most_between + 0.2);
}

TEST(CompactBasis, OfFewSignaturesHasFewAxes) {
  const std::vector<ShapeSignature> signatures = MakeClusters(3, 1);
  ASSERT_OK_AND_ASSIGN(const CompactBasis basis,
                       FitCompactBasis(Pointers(signatures)));
  EXPECT_EQ(basis.axes.cols(), 2);
  const CompactVector a = ProjectSignature(basis, signatures[0]);
  const CompactVector b = ProjectSignature(basis, signatures[1]);
  EXPECT_LT(CompactSimilarity(a, b), 0.5);
}

TEST(CompactBasis, RepeatsToTheBit) {
  const std::vector<ShapeSignature> signatures = MakeClusters(4, 5);
  ASSERT_OK_AND_ASSIGN(const CompactBasis a,
                       FitCompactBasis(Pointers(signatures)));
  ASSERT_OK_AND_ASSIGN(const CompactBasis b,
                       FitCompactBasis(Pointers(signatures)));
  EXPECT_EQ(EncodeCompactBasis(a), EncodeCompactBasis(b));
}

TEST(CompactBasis, NeedsTwoDifferentSignatures) {
  const std::vector<ShapeSignature> signatures = MakeClusters(1, 1);
  EXPECT_THAT(FitCompactBasis(Pointers(signatures)),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("of 1 signatures")));
  const std::vector<ShapeSignature> equal(3, signatures[0]);
  EXPECT_THAT(FitCompactBasis(Pointers(equal)),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("3 equal signatures")));
}

TEST(CompactBasis, GivesAZeroForItsMean) {
  const std::vector<ShapeSignature> signatures = MakeClusters(2, 1);
  ASSERT_OK_AND_ASSIGN(CompactBasis basis,
                       FitCompactBasis(Pointers(signatures)));
  for (int i = 0; i < kPointDims; ++i) {
    basis.mean[i] = static_cast<float>(std::sqrt(kPointScale.weight)) *
                    signatures[0].point[static_cast<size_t>(i)];
  }
  for (int i = 0; i < kViewDims; ++i) {
    basis.mean[kPointDims + i] =
        static_cast<float>(std::sqrt(kViewScale.weight)) *
        signatures[0].view[static_cast<size_t>(i)];
  }
  const CompactVector zero = ProjectSignature(basis, signatures[0]);
  EXPECT_EQ(zero, CompactVector{});
  EXPECT_EQ(CompactSimilarity(zero, zero), 0.0);
}

TEST(CompactBasis, SurvivesItsBytes) {
  const std::vector<ShapeSignature> signatures = MakeClusters(4, 5);
  ASSERT_OK_AND_ASSIGN(const CompactBasis basis,
                       FitCompactBasis(Pointers(signatures)));
  const std::string bytes = EncodeCompactBasis(basis);
  ASSERT_OK_AND_ASSIGN(const CompactBasis decoded, DecodeCompactBasis(bytes));
  EXPECT_EQ(EncodeCompactBasis(decoded), bytes);
  EXPECT_EQ(ProjectSignature(decoded, signatures[3]),
            ProjectSignature(basis, signatures[3]));
  EXPECT_THAT(DecodeCompactBasis(bytes.substr(0, bytes.size() - 1)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("basis")));
  EXPECT_THAT(
      DecodeCompactBasis(
          SealBytes("ARGB", kSignatureVersion + 1, bytes.substr(kSealBytes))),
      StatusIs(absl::StatusCode::kFailedPrecondition, HasSubstr("version")));
}

TEST(CompactBasis, RefusesACountThatTheBytesCannotHold) {
  const std::vector<ShapeSignature> signatures = MakeClusters(4, 5);
  ASSERT_OK_AND_ASSIGN(const CompactBasis basis,
                       FitCompactBasis(Pointers(signatures)));
  std::string payload = EncodeCompactBasis(basis).substr(kSealBytes);
  const size_t count_at = sizeof(float) * kSignatureDims;
  payload[count_at + 3] = '\x7f';
  EXPECT_THAT(DecodeCompactBasis(SealBytes("ARGB", kSignatureVersion, payload)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("basis")));
  payload[count_at + 3] = 0;
  payload[count_at] = 0;
  EXPECT_THAT(DecodeCompactBasis(SealBytes("ARGB", kSignatureVersion, payload)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("0 axes")));
}

}  // namespace
}  // namespace argmesh
