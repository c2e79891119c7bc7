#include "client/picture/figure.h"

#include <algorithm>
#include <cstddef>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr int kFrame = 4;  // pixels

absl::Status CheckRange(const char* name, int value, int low, int high) {
  if (value >= low && value <= high) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrFormat("%s %d is outside %d .. %d", name, value, low, high));
}

int LineHeight(const FigureOptions& options) {
  return 3 * options.caption_pixels / 2 + 4;
}

struct Grid {
  int columns = 1;
  int rows = 1;
  int width = 0;    // of the widest image
  int height = 0;   // of the highest
  int caption = 0;  // height of the captions' line
  int top = 0;      // of the first row

  int CellWidth() const { return width + 2 * kFrame; }
  int CellHeight() const { return height + 2 * kFrame + caption; }
};

Grid LayOut(std::span<const Panel> panels, const FigureOptions& options) {
  const int count = static_cast<int>(panels.size());
  Grid grid;
  grid.columns =
      options.columns == 0 ? count : std::min(options.columns, count);
  grid.rows = (count + grid.columns - 1) / grid.columns;
  for (const Panel& panel : panels) {
    grid.width = std::max(grid.width, panel.image.width());
    grid.height = std::max(grid.height, panel.image.height());
    if (!panel.caption.empty()) grid.caption = LineHeight(options);
  }
  if (!options.title.empty()) grid.top = LineHeight(options) + options.gap;
  return grid;
}

void PastePanel(const Panel& panel, const Grid& grid, int x, int y,
                Image& image) {
  image.Paste(panel.image, x + kFrame + (grid.width - panel.image.width()) / 2,
              y + kFrame + (grid.height - panel.image.height()) / 2);
  if (panel.frame) {
    image.DrawFrame(x, y, grid.CellWidth(), grid.CellHeight(), kFrame,
                    *panel.frame);
  }
}

}  // namespace

const CaptionFont& FontOf(const FigureOptions& options) {
  return options.font == nullptr ? CaptionFont::Default() : *options.font;
}

absl::Status CheckFigureOptions(const FigureOptions& options) {
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("panel_width", options.panel_width, 16, 4096));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("panel_height", options.panel_height, 16, 4096));
  ARGMESH_RETURN_IF_ERROR(CheckRange("columns", options.columns, 0, 1000));
  ARGMESH_RETURN_IF_ERROR(CheckRange("gap", options.gap, 0, 1000));
  return CheckRange("caption_pixels", options.caption_pixels, 4, 500);
}

absl::StatusOr<Figure> Compose(std::span<const Panel> panels,
                               const FigureOptions& options) {
  ARGMESH_RETURN_IF_ERROR(CheckFigureOptions(options));
  if (panels.empty()) {
    return absl::InvalidArgumentError("a figure needs a panel");
  }
  const Grid grid = LayOut(panels, options);
  const int gap = options.gap;
  Figure figure{
      .image = Image(grid.columns * (grid.CellWidth() + gap) + gap,
                     grid.top + grid.rows * (grid.CellHeight() + gap) + gap)};
  const CaptionFont& font = FontOf(options);
  const CaptionStyle style{.pixels = options.caption_pixels,
                           .align = CaptionAlign::kCenter};
  const PixelBox title{gap, gap, figure.image.width() - 2 * gap,
                       LineHeight(options)};
  bool drawn = font.Draw(figure.image, title, options.title, style);
  for (size_t i = 0; i < panels.size(); ++i) {
    const int column = static_cast<int>(i) % grid.columns;
    const int row = static_cast<int>(i) / grid.columns;
    const int x = gap + column * (grid.CellWidth() + gap);
    const int y = grid.top + gap + row * (grid.CellHeight() + gap);
    PastePanel(panels[i], grid, x, y, figure.image);
    const PixelBox below{x + kFrame, y + kFrame + grid.height, grid.width,
                         LineHeight(options)};
    drawn = font.Draw(figure.image, below, panels[i].caption, style) && drawn;
  }
  figure.captions_left_out = !drawn;
  return figure;
}

}  // namespace argmesh
