#include "core/signature/depth_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

size_t Pixel(int x, int y) { return static_cast<size_t>(y * kImageSize + x); }

TEST(ViewDirections, LookFromAllRoundInOppositePairs) {
  const std::vector<Eigen::Vector3d> directions = ViewDirections();
  ASSERT_EQ(directions.size(), 42U);
  for (size_t i = 0; i < directions.size(); i += 2) {
    EXPECT_NEAR(directions[i].norm(), 1, 1e-12);
    EXPECT_EQ(directions[i + 1], -directions[i]);
  }
  for (size_t i = 0; i < directions.size(); ++i) {
    double nearest = -1;
    for (size_t j = 0; j < directions.size(); ++j) {
      if (j != i) nearest = std::max(nearest, directions[i].dot(directions[j]));
    }
    EXPECT_LT(nearest, 0.86) << i;  // at least 30 degrees
    EXPECT_GT(nearest, 0.8) << i;
  }
}

TEST(DepthRenderer, ShowsASheetFromBothSidesAndNotFromItsEdge) {
  TriangleMesh sheet = MakeSheet(4);
  sheet.V.rowwise() -= sheet.V.colwise().mean();
  const DepthRenderer renderer(sheet);
  const auto views = renderer.Render(Eigen::Vector3d::UnitZ());
  for (const DepthImage& view : views) {
    EXPECT_NEAR(view[Pixel(64, 64)], 0.65, 1e-3);
    EXPECT_EQ(view[Pixel(0, 0)], 0);
    const auto seen =
        std::count_if(view.begin(), view.end(), [](float z) { return z > 0; });
    // A square of half diagonal 0.98 in an image of half width 1.
    EXPECT_NEAR(static_cast<double>(seen) / (kImageSize * kImageSize),
                0.98 * 0.98 / 2, 0.02);
  }
}

TEST(DepthRenderer, ShowsNearAndFarSides) {
  // A small sheet in front of a large one, along z.
  TriangleMesh large = MakeSheet(4);
  large.V.rowwise() -= large.V.colwise().mean();
  TriangleMesh small = large;
  small.V *= 0.2;
  small.V.col(2).setConstant(0.3);
  const TriangleMesh both = Join(large, small);
  const DepthRenderer renderer(both);
  const auto views = renderer.Render(Eigen::Vector3d::UnitZ());
  EXPECT_GT(views[0][Pixel(64, 64)], views[0][Pixel(40, 64)] + 0.05F);
  EXPECT_NEAR(views[1][Pixel(64, 64)], views[1][Pixel(40, 64)], 1e-4);
}

TEST(CloseImage, FillsGapsAndKeepsTheOutline) {
  DepthImage image(size_t{kImageSize} * kImageSize, 0);
  for (int y = 30; y < 90; ++y) {
    for (int x = 30; x < 90; ++x) image[Pixel(x, y)] = 0.5F;
  }
  const DepthImage whole = image;
  for (int y = 40; y < 44; ++y) {
    for (int x = 50; x < 70; ++x) image[Pixel(x, y)] = 0;
  }
  for (int y = 60; y < 70; ++y) {
    for (int x = 60; x < 70; ++x) image[Pixel(x, y)] = 0;
  }
  CloseImage(image);
  EXPECT_EQ(image[Pixel(60, 42)], 0.5F);  // four pixels high: closed
  EXPECT_EQ(image[Pixel(65, 65)], 0.0F);  // ten: stays
  EXPECT_EQ(image[Pixel(29, 50)], 0.0F);
  EXPECT_EQ(image[Pixel(30, 50)], 0.5F);
  DepthImage unchanged = whole;
  CloseImage(unchanged);
  EXPECT_EQ(unchanged, whole);
}

TEST(HalveImage, AveragesFours) {
  const DepthImage image = {0, 1, 2,  3,  4,  5,  6,  7,
                            8, 9, 10, 11, 12, 13, 14, 15};
  EXPECT_THAT(HalveImage(image, 4),
              testing::ElementsAre(2.5F, 4.5F, 10.5F, 12.5F));
}

}  // namespace
}  // namespace argmesh
