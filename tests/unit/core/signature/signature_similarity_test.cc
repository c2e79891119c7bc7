#include "core/signature/signature_similarity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/signature/similarity_scale.h"
#include "tests/unit/core/signature/random_signature.h"

namespace argmesh {
namespace {

TEST(SignatureSimilarity, IsOneForEqualSignaturesOnly) {
  const ShapeSignature a = MakeRandomSignature(1);
  EXPECT_EQ(SignatureSimilarity(a, a), 1.0);
  EXPECT_EQ(SignatureSimilarity(PackedSignature(a), PackedSignature(a)), 1.0);
  EXPECT_LT(SignatureSimilarity(a, PerturbSignature(a, 0.5F, 2)), 1.0);
}

TEST(SignatureSimilarity, IsSymmetricAndFallsWithTheDifference) {
  const ShapeSignature a = MakeRandomSignature(1);
  double before = 1;
  for (const float amount : {0.2F, 0.5F, 1.0F, 3.0F}) {
    const ShapeSignature b = PerturbSignature(a, amount, 2);
    const double similarity = SignatureSimilarity(a, b);
    EXPECT_EQ(similarity, SignatureSimilarity(b, a));
    EXPECT_LT(similarity, before);
    EXPECT_GE(similarity, 0.0);
    before = similarity;
  }
}

TEST(SignatureSimilarity, LooksAtEveryPart) {
  const ShapeSignature a = MakeRandomSignature(1);
  const ShapeSignature other = MakeRandomSignature(2);
  using Part = std::vector<float> ShapeSignature::*;
  for (const Part part : {&ShapeSignature::point, &ShapeSignature::view}) {
    ShapeSignature differs = a;
    differs.*part = other.*part;
    EXPECT_LT(SignatureSimilarity(a, differs), 0.95);
    EXPECT_LT(SignatureSimilarity(a, other), SignatureSimilarity(a, differs));
  }
}

TEST(SignatureSimilarity, KnowsTwoSurfacesOfWhichNothingIsSeen) {
  ShapeSignature a = MakeRandomSignature(1);
  a.view.assign(kViewDims, 0);
  EXPECT_EQ(SignatureSimilarity(a, a), 1.0);
  EXPECT_EQ(SignatureSimilarity(PackedSignature(a), PackedSignature(a)), 1.0);
}

TEST(PackedSignature, ComparesAsWhatWasPacked) {
  const ShapeSignature a = MakeRandomSignature(1);
  const PackedSignature packed(a);
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const ShapeSignature b =
        PerturbSignature(a, 0.01F * static_cast<float>(seed), seed);
    const PackedSignature other(b);
    EXPECT_NEAR(SignatureSimilarity(packed, other), SignatureSimilarity(a, b),
                1e-3)
        << seed;
    EXPECT_EQ(SignatureSimilarity(packed, other),
              SignatureSimilarity(other, packed));
  }
}

TEST(PackedSignature, HoldsTheLongestProductsWithoutOverflow) {
  ShapeSignature peak = MakeRandomSignature(1);
  peak.point.assign(kPointDims, 0);
  peak.view.assign(kViewDims, 0);
  peak.point[0] = 1;
  peak.view[0] = 1;
  ShapeSignature opposite = peak;
  opposite.point[0] = -1;
  opposite.view[0] = -1;
  EXPECT_NEAR(
      SignatureSimilarity(PackedSignature(peak), PackedSignature(opposite)),
      SignatureSimilarity(peak, opposite), 1e-6);
}

TEST(SimilarityScale, StartsAtOneAndFalls) {
  double weights = 0;
  for (const SimilarityScale& scale : {kPointScale, kViewScale}) {
    weights += scale.weight;
    EXPECT_EQ(ScaledSimilarity(scale, 0), 1.0);
    EXPECT_NEAR(ScaledSimilarity(scale, scale.half * scale.half), 0.5, 1e-12);
    double before = 1;
    for (double squared = 0.25; squared <= 4; squared += 0.25) {
      EXPECT_LT(ScaledSimilarity(scale, squared), before);
      before = ScaledSimilarity(scale, squared);
    }
    EXPECT_GE(before, 0.0);
  }
  EXPECT_DOUBLE_EQ(weights, 1);
}

TEST(CompareHandedness, TellsMirroredFromSame) {
  const ShapeSignature a = MakeRandomSignature(1);
  ShapeSignature mirrored = a;
  for (float& value : mirrored.chirality) value = -value;
  EXPECT_EQ(CompareHandedness(a, a), Handedness::kSame);
  EXPECT_EQ(CompareHandedness(a, mirrored), Handedness::kMirrored);
  EXPECT_EQ(CompareHandedness(mirrored, a), Handedness::kMirrored);
}

TEST(CompareHandedness, DoesNotDecideOnSymmetricShapes) {
  ShapeSignature a = MakeRandomSignature(1);
  for (float& value : a.chirality) value *= 0.001F;
  ShapeSignature mirrored = a;
  for (float& value : mirrored.chirality) value = -value;
  EXPECT_EQ(CompareHandedness(a, a), Handedness::kUndecided);
  EXPECT_EQ(CompareHandedness(a, mirrored), Handedness::kUndecided);
  EXPECT_EQ(CompareHandedness(a, MakeRandomSignature(1)),
            Handedness::kUndecided);
}

TEST(CompareHandedness, DoesNotDecideBetweenUnlikeShapes) {
  ShapeSignature a = MakeRandomSignature(1);
  ShapeSignature b = a;
  a.chirality = {0.4F, 0, 0, 0, 0, 0, 0, 0};
  b.chirality = {0, 0.4F, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(CompareHandedness(a, b), Handedness::kUndecided);
}

}  // namespace
}  // namespace argmesh
