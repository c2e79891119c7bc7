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
  const int count = static_cast<int>(panels.size());
  const int columns =
      options.columns == 0 ? count : std::min(options.columns, count);
  const int rows = (count + columns - 1) / columns;
  int width = 0;
  int height = 0;
  bool any_caption = false;
  for (const Panel& panel : panels) {
    width = std::max(width, panel.image.width());
    height = std::max(height, panel.image.height());
    any_caption = any_caption || !panel.caption.empty();
  }
  const int line = 3 * options.caption_pixels / 2 + 4;
  const int cell_width = width + 2 * kFrame;
  const int cell_height = height + 2 * kFrame + (any_caption ? line : 0);
  const int top = options.title.empty() ? 0 : line + options.gap;
  const int gap = options.gap;
  Figure figure{.image = Image(columns * (cell_width + gap) + gap,
                               top + rows * (cell_height + gap) + gap)};
  const CaptionFont& font = FontOf(options);
  const CaptionStyle style{.pixels = options.caption_pixels,
                           .align = CaptionAlign::kCenter};
  bool drawn =
      font.Draw(figure.image, {gap, gap, figure.image.width() - 2 * gap, line},
                options.title, style);
  for (int i = 0; i < count; ++i) {
    const Panel& panel = panels[static_cast<size_t>(i)];
    const int x = gap + i % columns * (cell_width + gap);
    const int y = top + gap + i / columns * (cell_height + gap);
    figure.image.Paste(panel.image,
                       x + kFrame + (width - panel.image.width()) / 2,
                       y + kFrame + (height - panel.image.height()) / 2);
    drawn =
        font.Draw(figure.image, {x + kFrame, y + kFrame + height, width, line},
                  panel.caption, style) &&
        drawn;
    if (panel.frame) {
      figure.image.DrawFrame(x, y, cell_width, cell_height, kFrame,
                             *panel.frame);
    }
  }
  figure.captions_left_out = !drawn;
  return figure;
}

}  // namespace argmesh
