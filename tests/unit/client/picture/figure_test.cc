#include "client/picture/figure.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "client/picture/figure_matrix.h"
#include "client/picture/figure_shapes.h"
#include "client/picture/palette.h"
#include "core/synthesis/sample_shape.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

SampleShape Sample(const char* name, uint64_t seed = 1) {
  return MakeSampleShape(name, seed, {.target_vertices = 1500}).value();
}

FigureOptions SmallOptions() {
  FigureOptions options{.panel_width = 96, .panel_height = 80};
  options.render.ambient_rays = 4;
  return options;
}

// Pixels whose hue is near the colour's, light or dark.
int PixelsLike(const Image& image, RgbColor color) {
  const Eigen::Vector2d wanted = LabOfRgb(color).tail<2>();
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Eigen::Vector2d seen = LabOfRgb(image.At(x, y)).tail<2>();
      if (seen.norm() < 15) continue;
      if (seen.normalized().dot(wanted.normalized()) > 0.97) ++count;
    }
  }
  return count;
}

TEST(Compose, PlacesPanelsRowByRow) {
  const std::vector<Panel> panels = {{.image = Image(20, 10, kBad)},
                                     {.image = Image(20, 10, kGood)},
                                     {.image = Image(20, 10, kBlack)}};
  ASSERT_OK_AND_ASSIGN(const Figure figure,
                       Compose(panels, {.columns = 2, .gap = 5}));
  EXPECT_FALSE(figure.captions_left_out);
  EXPECT_EQ(figure.image.width(), 2 * 28 + 3 * 5);
  EXPECT_EQ(figure.image.height(), 2 * 18 + 3 * 5);
  EXPECT_EQ(figure.image.At(19, 14), kBad);
  EXPECT_EQ(figure.image.At(52, 14), kGood);
  EXPECT_EQ(figure.image.At(19, 37), kBlack);
  EXPECT_EQ(figure.image.At(52, 37), kWhite);
}

TEST(Compose, SaysThatCaptionsAreLeftOutWithoutAFont) {
  const CaptionFont none("/nonexistent/font.ttf");
  std::vector<Panel> panels = {{.image = Image(20, 10, kBad)}};
  FigureOptions options{.font = &none};
  EXPECT_FALSE(Compose(panels, options).value().captions_left_out);
  panels[0].caption = "mug";
  EXPECT_TRUE(Compose(panels, options).value().captions_left_out);
  options.title = "all";
  EXPECT_THAT(Compose(panels, options), IsOk());
}

TEST(Compose, RefusesOptionsOutsideTheirRange) {
  EXPECT_THAT(Compose({}), StatusIs(absl::StatusCode::kInvalidArgument,
                                    HasSubstr("needs a panel")));
  const std::vector<Panel> panels = {{.image = Image(4, 4)}};
  EXPECT_THAT(
      Compose(panels, {.panel_width = 5}),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("panel_width 5")));
  EXPECT_THAT(
      Compose(panels, {.gap = -1}),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("gap -1")));
}

TEST(RenderMatrix, DrawsHigherValuesDarker) {
  const CaptionFont none("/nonexistent/font.ttf");
  Eigen::MatrixXd values(2, 3);
  values << 0.0, 0.5, 1.0, 0.25, std::numeric_limits<double>::quiet_NaN(), 0.75;
  ASSERT_OK_AND_ASSIGN(const Figure figure,
                       RenderMatrix(values, {"a", "b"}, {"x", "y", "z"},
                                    {.cell_pixels = 30, .font = &none}));
  EXPECT_TRUE(figure.captions_left_out);
  const auto color = [&](int r, int c) {
    return figure.image.At(16 + 30 * c + 10, 16 + 30 * r + 10);
  };
  EXPECT_EQ(color(0, 0), ScaleColor(0));
  EXPECT_EQ(color(0, 1), ScaleColor(0.5));
  EXPECT_EQ(color(0, 2), ScaleColor(1));
  EXPECT_EQ(color(1, 0), ScaleColor(0.25));
  EXPECT_EQ(color(1, 1), kPaleGrey);
  EXPECT_EQ(color(1, 2), ScaleColor(0.75));
}

TEST(RenderMatrix, RefusesNamesThatDoNotMatch) {
  const Eigen::MatrixXd values = Eigen::MatrixXd::Ones(2, 2);
  EXPECT_THAT(RenderMatrix(values, {"a"}, {"x", "y"}),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("1 row names and 2 column names")));
  EXPECT_THAT(RenderMatrix({}, {}, {}),
              StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("empty")));
  EXPECT_THAT(RenderMatrix(values, {"a", "b"}, {"x", "y"}), IsOk());
}

TEST(RenderPair, ColorsMatchesAlikeAndTheRestGrey) {
  const SampleShape mug = Sample("mug");
  const SampleShape teapot = Sample("teapot");
  PairSide left{.mesh = &mug.mesh, .match_of_face = mug.part_of_face};
  PairSide right{.mesh = &teapot.mesh};
  for (const int32_t part : teapot.part_of_face) {
    right.match_of_face.push_back(
        teapot.part_names[static_cast<size_t>(part)] == "handle" ? 1 : -1);
  }
  ASSERT_OK_AND_ASSIGN(const Figure figure,
                       RenderPair(left, right, SmallOptions()));
  const int width = figure.image.width();
  Image halves[2] = {Image(width / 2, figure.image.height()),
                     Image(width / 2, figure.image.height())};
  halves[0].Paste(figure.image, 0, 0);
  halves[1].Paste(figure.image, -width / 2, 0);
  EXPECT_GT(PixelsLike(halves[0], CategoricalColor(1)), 30);
  EXPECT_GT(PixelsLike(halves[1], CategoricalColor(1)), 30);
  EXPECT_GT(PixelsLike(halves[0], CategoricalColor(0)), 300);
  EXPECT_LT(PixelsLike(halves[1], CategoricalColor(0)), 10);
  left.match_of_face.pop_back();
  EXPECT_THAT(
      RenderPair(left, right, SmallOptions()),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("labels for")));
}

TEST(RenderLevels, LetsTheLargestPartKeepTheColor) {
  const SampleShape table = Sample("table");
  const size_t faces = table.part_of_face.size();
  // Numbers of the finer level say nothing about those of the coarser.
  std::vector<int32_t> fine;
  for (const int32_t part : table.part_of_face) fine.push_back(7 - part);
  const std::vector<LevelPanel> levels = {
      {.component_of_face = std::vector<int32_t>(faces, 3)},
      {.component_of_face = fine}};
  ASSERT_OK_AND_ASSIGN(const Figure figure,
                       RenderLevels(table.mesh, levels, SmallOptions()));
  Image second(figure.image.width() / 2, figure.image.height());
  second.Paste(figure.image, -figure.image.width() / 2, 0);
  EXPECT_GT(PixelsLike(second, CategoricalColor(0)),
            PixelsLike(second, CategoricalColor(1)));
  EXPECT_GT(PixelsLike(second, CategoricalColor(1)), 20);
}

TEST(RenderModes, ShowsRedDotsFromThreeSides) {
  const SampleShape hand = Sample("hand");
  std::vector<SurfaceMarker> modes;
  for (int v = 0; v < hand.mesh.num_vertices(); v += 100) {
    modes.push_back({.position = hand.mesh.vertex(v), .window = 0.05});
  }
  ASSERT_OK_AND_ASSIGN(const Figure figure,
                       RenderModes(hand.mesh, modes, SmallOptions()));
  EXPECT_EQ(figure.image.width(), 3 * (96 + 8) + 4 * 10);
  EXPECT_GT(PixelsLike(figure.image, SurfaceMarker{}.dot), 100);
}

TEST(RenderContactSheet, FramesRelevantResultsGreenAndOthersRed) {
  const SampleShape key = Sample("key");
  const SampleShape other = Sample("key", 2);
  const SampleShape fish = Sample("fish");
  const std::vector<RankedShape> results = {
      {.mesh = &other.mesh, .class_name = "key", .score = 1, .relevant = true},
      {.mesh = &fish.mesh, .class_name = "fish", .score = 0.25}};
  ASSERT_OK_AND_ASSIGN(
      const Figure figure,
      RenderContactSheet(key.mesh, "query", results, SmallOptions()));
  const Image& image = figure.image;
  EXPECT_EQ(image.width(), 3 * (96 + 8) + 4 * 10);
  EXPECT_EQ(image.At(11, 11), kInk);
  EXPECT_EQ(image.At(11 + 114, 11), kGood);
  EXPECT_EQ(image.At(11 + 2 * 114, 11), kBad);
  EXPECT_THAT(
      RenderContactSheet(key.mesh, "query", std::vector<RankedShape>(1)),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("no mesh")));
}

}  // namespace
}  // namespace argmesh
