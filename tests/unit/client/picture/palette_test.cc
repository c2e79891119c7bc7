#include "client/picture/palette.h"

#include <gtest/gtest.h>

#include <vector>

#include "client/picture/image.h"

namespace argmesh {
namespace {

TEST(LabOfRgb, MeetsPublishedValues) {
  EXPECT_TRUE(LabOfRgb(kWhite).isApprox(Eigen::Vector3d(100, 0, 0), 1e-3));
  EXPECT_TRUE(LabOfRgb(kBlack).isZero(1e-6));
  const Eigen::Vector3d red = LabOfRgb({255, 0, 0});
  EXPECT_NEAR(red[0], 53.24, 0.02);
  EXPECT_NEAR(red[1], 80.09, 0.02);
  EXPECT_NEAR(red[2], 67.20, 0.02);
}

TEST(CategoricalColor, KeepsColorsFarApart) {
  // A difference of 2.3 is just noticeable.
  for (int i = 0; i < 48; ++i) {
    for (int j = 0; j < i; ++j) {
      const double difference =
          ColorDifference(CategoricalColor(i), CategoricalColor(j));
      EXPECT_GT(difference, i < 24 ? 24 : 15) << i << " and " << j;
    }
    EXPECT_GT(ColorDifference(CategoricalColor(i), kPaleGrey), 15) << i;
    EXPECT_GT(ColorDifference(CategoricalColor(i), kWhite), 20) << i;
    EXPECT_GT(ColorDifference(CategoricalColor(i), kInk), 20) << i;
  }
}

TEST(ColorsOfLabels, GivesGreyToNegativeLabels) {
  const std::vector<int32_t> labels = {2, -1, 2, 0};
  const std::vector<RgbColor> colors = ColorsOfLabels(labels);
  ASSERT_EQ(colors.size(), 4U);
  EXPECT_EQ(colors[0], CategoricalColor(2));
  EXPECT_EQ(colors[1], kPaleGrey);
  EXPECT_EQ(colors[2], colors[0]);
  EXPECT_EQ(colors[3], CategoricalColor(0));
}

TEST(ScaleColor, DarkensSteadily) {
  double before = 101;
  for (int i = 0; i <= 20; ++i) {
    const double lightness = LabOfRgb(ScaleColor(i / 20.0))[0];
    EXPECT_LT(lightness, before) << i;
    before = lightness;
  }
  EXPECT_EQ(ScaleColor(-3), ScaleColor(0));
  EXPECT_EQ(ScaleColor(7), ScaleColor(1));
  EXPECT_EQ(ScaleColor(0), kWhite);
}

}  // namespace
}  // namespace argmesh
