#include "client/picture/image.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

uint32_t BigEndian(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = at; i < at + 4; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

TEST(SerializePng, WritesSignatureAndDimensions) {
  Image image(37, 21);
  image.Set(3, 4, kBad);
  ASSERT_OK_AND_ASSIGN(const std::string png, SerializePng(image));
  ASSERT_GT(png.size(), 33U);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1A\n");
  EXPECT_EQ(png.substr(12, 4), "IHDR");
  EXPECT_EQ(BigEndian(png, 16), 37U);
  EXPECT_EQ(BigEndian(png, 20), 21U);
  EXPECT_EQ(png[24], 8);  // bits a channel
  EXPECT_EQ(png[25], 2);  // RGB
  EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
  ASSERT_OK_AND_ASSIGN(const std::string again, SerializePng(image));
  EXPECT_EQ(png, again);
}

TEST(SerializePng, RefusesEmptyAndHugeImages) {
  EXPECT_THAT(SerializePng(Image()),
              StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("0 x 0")));
  EXPECT_THAT(
      SerializePng(Image(30'001, 1)),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("30001 x 1")));
}

TEST(WritePng, SaysWhichFileItCannotWrite) {
  EXPECT_THAT(WritePng(Image(2, 2), "/nonexistent/a.png"),
              StatusIs(absl::StatusCode::kUnavailable,
                       HasSubstr("/nonexistent/a.png")));
  const std::string path = ::testing::TempDir() + "argmesh_image_test.png";
  EXPECT_THAT(WritePng(Image(2, 2), path), IsOk());
  EXPECT_GT(std::filesystem::file_size(path), 50U);
  std::filesystem::remove(path);
}

TEST(Image, LeavesOutWhatLiesBeyondItsEdges) {
  Image image(10, 8);
  image.FillRectangle(-5, -5, 8, 7, kBlack);
  image.Paste(Image(4, 4, kBad), 8, 6);
  image.Blend(-1, 3, kBlack, 1);
  image.Blend(10, 3, kBlack, 1);
  image.Blend(5, 5, kBlack, 0.5);
  EXPECT_EQ(image.At(2, 1), kBlack);
  EXPECT_EQ(image.At(3, 1), kWhite);
  EXPECT_EQ(image.At(2, 2), kWhite);
  EXPECT_EQ(image.At(9, 7), kBad);
  EXPECT_EQ(image.At(7, 7), kWhite);
  EXPECT_EQ(image.At(5, 5), (RgbColor{128, 128, 128}));
}

TEST(Image, DrawsAFrameInsideItsRectangle) {
  Image image(10, 10);
  image.DrawFrame(1, 1, 8, 8, 2, kGood);
  EXPECT_EQ(image.At(0, 0), kWhite);
  EXPECT_EQ(image.At(1, 1), kGood);
  EXPECT_EQ(image.At(2, 7), kGood);
  EXPECT_EQ(image.At(8, 8), kGood);
  EXPECT_EQ(image.At(9, 9), kWhite);
  EXPECT_EQ(image.At(3, 3), kWhite);
}

}  // namespace
}  // namespace argmesh
