// Words in pictures, set in a TrueType font found on this machine.
//
// Without a font nothing is drawn and the calls say so; pictures are complete
// but for their captions.
// Repeats  equal font, text and size give equal pixels.
// Cost     about 10 us a letter. Const calls are thread-safe.
#ifndef ARGMESH_CLIENT_PICTURE_CAPTION_FONT_H_
#define ARGMESH_CLIENT_PICTURE_CAPTION_FONT_H_

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "client/picture/image.h"

namespace argmesh {

// How much of each pixel ink covers, rows top to bottom.
struct InkCoverage {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> ink;  // 0 .. 255
};

enum class CaptionAlign { kLeft, kCenter, kRight };

struct CaptionStyle {
  int pixels = 14;  // height of the font, 4 .. 500
  RgbColor color = kInk;
  CaptionAlign align = CaptionAlign::kLeft;
  bool upward = false;  // read from bottom to top
};

struct PixelBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

class CaptionFont {
 public:
  // Unavailable when the file is missing or no font.
  explicit CaptionFont(const std::string& path);
  ~CaptionFont();

  // DejaVu Sans, Liberation Sans or FreeSans from the usual folders.
  static const CaptionFont& Default();

  bool available() const;

  // Empty without a font. `text` is UTF-8; bad bytes are left out.
  InkCoverage Rasterize(std::string_view text, int pixels) const;

  // In the middle of the box's height (of its width when upward), cut short
  // with an ellipsis where it does not fit. False when nothing could be drawn
  // for want of a font.
  bool Draw(Image& image, const PixelBox& box, std::string_view text,
            const CaptionStyle& style = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_CAPTION_FONT_H_
