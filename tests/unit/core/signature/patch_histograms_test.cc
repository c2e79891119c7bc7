#include "core/signature/patch_histograms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace argmesh {
namespace {

constexpr int kSize = 96;

// A soft blob off the patch's middle and a step, turned about the middle.
std::vector<float> MakeImage(double turn) {
  std::vector<float> image;
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double dx = x - 48.0;
      const double dy = y - 48.0;
      const double u = c * dx + s * dy;
      const double v = c * dy - s * dx;
      const double blob =
          std::exp(-((u - 6) * (u - 6) + (v + 4) * (v + 4)) / 60);
      const double step = 1 / (1 + std::exp(-(u + 2) / 2));
      image.push_back(static_cast<float>(0.5 * blob + step));
    }
  }
  return image;
}

Eigen::RowVectorXf Describe(const std::vector<float>& image) {
  Eigen::RowVectorXf histogram = Eigen::RowVectorXf::Zero(kPatchDims);
  EXPECT_TRUE(
      DescribePatch(ComputeGradients(image, kSize), {48, 48, 32}, histogram));
  return histogram;
}

TEST(DescribePatch, HasUnitLengthAndNothingNegative) {
  const Eigen::RowVectorXf histogram = Describe(MakeImage(0.3));
  EXPECT_NEAR(histogram.norm(), 1, 1e-5);
  EXPECT_GE(histogram.minCoeff(), 0);
}

TEST(DescribePatch, TurnsWithTheImage) {
  const Eigen::RowVectorXf upright = Describe(MakeImage(0));
  for (const double turn : {0.4, 1.3, 2.9, -2.0}) {
    EXPECT_GT(upright.dot(Describe(MakeImage(turn))), 0.97) << turn;
  }
}

TEST(DescribePatch, TellsAnImageFromItsMirrorImage) {
  const std::vector<float> image = MakeImage(0);
  std::vector<float> mirrored(image.size());
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      mirrored[static_cast<size_t>(y * kSize + x)] =
          image[static_cast<size_t>((kSize - 1 - y) * kSize + x)];
    }
  }
  EXPECT_LT(Describe(image).dot(Describe(mirrored)), 0.95);
}

TEST(DescribePatch, DoesNotDependOnContrast) {
  const std::vector<float> image = MakeImage(0.7);
  std::vector<float> faint = image;
  for (float& value : faint) value = 0.1F * value + 0.2F;
  EXPECT_TRUE(Describe(image).isApprox(Describe(faint), 1e-2F));
}

TEST(DescribePatch, SeesNothingInAFlatPatch) {
  const std::vector<float> flat(size_t{kSize} * kSize, 0.5F);
  Eigen::RowVectorXf histogram = Eigen::RowVectorXf::Constant(kPatchDims, 7);
  EXPECT_FALSE(
      DescribePatch(ComputeGradients(flat, kSize), {48, 48, 32}, histogram));
  EXPECT_EQ(histogram[0], 7);
}

TEST(DescribePatch, StaysInsideTheImage) {
  const GradientImage gradients = ComputeGradients(MakeImage(0.2), kSize);
  Eigen::RowVectorXf histogram = Eigen::RowVectorXf::Zero(kPatchDims);
  for (const float corner : {0.0F, 95.0F}) {
    DescribePatch(gradients, {corner, corner, 40}, histogram);
    EXPECT_TRUE(histogram.allFinite());
  }
}

}  // namespace
}  // namespace argmesh
