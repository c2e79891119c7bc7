// Pictures side by side with captions.
#ifndef ARGMESH_CLIENT_PICTURE_FIGURE_H_
#define ARGMESH_CLIENT_PICTURE_FIGURE_H_

#include <optional>
#include <span>
#include <string>

#include "client/picture/caption_font.h"
#include "client/picture/image.h"
#include "client/picture/render.h"

namespace argmesh {

struct Figure {
  Image image = {};
  bool captions_left_out = false;  // there is text but no font
};

struct Panel {
  Image image = {};
  std::string caption = {};  // below the image; may be empty
  std::optional<RgbColor> frame = std::nullopt;  // around image and caption
};

struct FigureOptions {
  int panel_width = 360;      // pixels, 16 .. 4,096
  int panel_height = 300;     // pixels, 16 .. 4,096
  int columns = 0;            // 0 .. 1,000; 0 for all panels in one row
  int gap = 10;               // pixels between panels, 0 .. 1,000
  int caption_pixels = 15;    // height of the font, 4 .. 500
  std::string title = {};     // above everything; may be empty
  RenderOptions render = {};  // its width and height give way to the panel's
  const CaptionFont* font = nullptr;  // CaptionFont::Default() for null
};

const CaptionFont& FontOf(const FigureOptions& options);

// kInvalidArgument names the option that is outside its range.
absl::Status CheckFigureOptions(const FigureOptions& options);

// Row by row, every panel in a cell of the largest panel's size. Fails as
// CheckFigureOptions; kInvalidArgument without panels.
absl::StatusOr<Figure> Compose(std::span<const Panel> panels,
                               const FigureOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_FIGURE_H_
