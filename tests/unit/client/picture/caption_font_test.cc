#include "client/picture/caption_font.h"

#include <gtest/gtest.h>

#include <string>

namespace argmesh {
namespace {

int InkedPixels(const Image& image, const PixelBox& box) {
  int inked = 0;
  for (int y = box.y; y < box.y + box.height; ++y) {
    for (int x = box.x; x < box.x + box.width; ++x) {
      inked += image.At(x, y) != kWhite ? 1 : 0;
    }
  }
  return inked;
}

TEST(CaptionFont, DrawsNothingAndSaysSoWithoutAFont) {
  const CaptionFont font("/nonexistent/font.ttf");
  EXPECT_FALSE(font.available());
  Image image(100, 30);
  EXPECT_FALSE(font.Draw(image, {0, 0, 100, 30}, "mug"));
  EXPECT_TRUE(font.Draw(image, {0, 0, 100, 30}, ""));
  EXPECT_EQ(InkedPixels(image, {0, 0, 100, 30}), 0);
  EXPECT_EQ(font.Rasterize("mug", 14).width, 0);
}

class CaptionFontTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!font_.available()) GTEST_SKIP() << "no font on this machine";
  }
  const CaptionFont& font_ = CaptionFont::Default();
};

TEST_F(CaptionFontTest, AlignsInsideTheBox) {
  const struct {
    CaptionAlign align;
    PixelBox inked, empty;
  } cases[] = {
      {CaptionAlign::kLeft, {0, 0, 60, 30}, {140, 0, 60, 30}},
      {CaptionAlign::kRight, {140, 0, 60, 30}, {0, 0, 60, 30}},
      {CaptionAlign::kCenter, {70, 0, 60, 30}, {0, 0, 60, 30}},
  };
  for (const auto& c : cases) {
    Image image(200, 30);
    EXPECT_TRUE(
        font_.Draw(image, {0, 0, 200, 30}, "chair", {.align = c.align}));
    EXPECT_GT(InkedPixels(image, c.inked), 30);
    EXPECT_EQ(InkedPixels(image, c.empty), 0);
  }
}

TEST_F(CaptionFontTest, TurnsTextThatReadsUpward) {
  Image image(30, 200);
  EXPECT_TRUE(font_.Draw(image, {0, 0, 30, 200}, "octopus", {.upward = true}));
  EXPECT_GT(InkedPixels(image, {0, 140, 30, 60}), 50);
  EXPECT_EQ(InkedPixels(image, {0, 0, 30, 100}), 0);
}

TEST_F(CaptionFontTest, CutsShortWhatDoesNotFit) {
  Image image(60, 30);
  EXPECT_TRUE(font_.Draw(image, {0, 0, 40, 30},
                         "a caption that is far too long to fit"));
  EXPECT_GT(InkedPixels(image, {0, 0, 40, 30}), 20);
  EXPECT_EQ(InkedPixels(image, {40, 0, 20, 30}), 0);
}

TEST_F(CaptionFontTest, SurvivesTextThatIsNotUtf8) {
  const std::string cases[] = {"\xFF\xFE",
                               "\xC3",
                               "a\xE2\x82",
                               "\xF0\x9F\x98",
                               std::string("a\0b", 3),
                               "\xC3\xA9t\xC3\xA9"};
  for (const std::string& text : cases) {
    Image image(80, 20);
    EXPECT_TRUE(font_.Draw(image, {0, 0, 80, 20}, text));
    EXPECT_TRUE(font_.Draw(image, {0, 0, 1, 20}, text));
  }
  EXPECT_EQ(font_
                .Rasterize("\xFF"
                           "ab",
                           14)
                .ink,
            font_.Rasterize("ab", 14).ink);
}

}  // namespace
}  // namespace argmesh
