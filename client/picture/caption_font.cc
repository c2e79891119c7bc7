#include "client/picture/caption_font.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <mutex>

#ifdef ARGMESH_HAVE_FREETYPE
#include <ft2build.h>
#include FT_FREETYPE_H
#endif

namespace argmesh {
namespace {

constexpr std::array<const char*, 5> kFontPaths = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/freefont/FreeSans.ttf"};

std::string FindFont() {
  for (const char* path : kFontPaths) {
    if (std::ifstream(path).good()) return path;
  }
  return "";
}

// The code point at `at`, which moves on; 0 for a byte that starts none.
uint32_t NextCodePoint(std::string_view text, size_t& at) {
  const auto byte = static_cast<unsigned char>(text[at++]);
  if (byte < 0x80) return byte;
  const int more = byte >= 0xF0 ? 3 : (byte >= 0xE0 ? 2 : 1);
  if (byte < 0xC2 || byte > 0xF4) return 0;
  uint32_t code = byte & (0x3FU >> more);
  for (int i = 0; i < more; ++i) {
    if (at >= text.size()) return 0;
    const auto next = static_cast<unsigned char>(text[at]);
    if ((next & 0xC0U) != 0x80U) return 0;
    code = code << 6 | (next & 0x3FU);
    ++at;
  }
  return code;
}

// Without its last letter and an ellipsis that is there already.
std::string Shorten(std::string_view text) {
  constexpr std::string_view kEllipsis = "\xE2\x80\xA6";
  if (text.size() >= kEllipsis.size() &&
      text.substr(text.size() - kEllipsis.size()) == kEllipsis) {
    text.remove_suffix(kEllipsis.size());
  }
  while (!text.empty()) {
    const bool inner =
        (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U;
    text.remove_suffix(1);
    if (!inner) break;
  }
  if (text.empty()) return "";
  return std::string(text) + std::string(kEllipsis);
}

int Slack(int room, int used, CaptionAlign align) {
  if (align == CaptionAlign::kLeft) return 0;
  return align == CaptionAlign::kCenter ? (room - used) / 2 : room - used;
}

void BlendInk(Image& image, int x, int y, const InkCoverage& ink,
              const CaptionStyle& style) {
  for (int j = 0; j < ink.height; ++j) {
    for (int i = 0; i < ink.width; ++i) {
      const double share =
          ink.ink[static_cast<size_t>(j) * static_cast<size_t>(ink.width) +
                  static_cast<size_t>(i)] /
          255.0;
      if (share <= 0) continue;
      const int px = style.upward ? x + j : x + i;
      const int py = style.upward ? y + ink.width - 1 - i : y + j;
      image.Blend(px, py, style.color, share);
    }
  }
}

}  // namespace

#ifdef ARGMESH_HAVE_FREETYPE

struct CaptionFont::Impl {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  std::mutex mutex;  // a face has one size and one glyph at a time
};

CaptionFont::CaptionFont(const std::string& path)
    : impl_(std::make_unique<Impl>()) {
  if (path.empty() || FT_Init_FreeType(&impl_->library) != 0) return;
  if (FT_New_Face(impl_->library, path.c_str(), 0, &impl_->face) != 0) {
    impl_->face = nullptr;
  }
}

CaptionFont::~CaptionFont() {
  if (impl_->face != nullptr) FT_Done_Face(impl_->face);
  if (impl_->library != nullptr) FT_Done_FreeType(impl_->library);
}

bool CaptionFont::available() const { return impl_->face != nullptr; }

namespace {

void CopyGlyph(const FT_GlyphSlot glyph, int pen, int baseline,
               InkCoverage& ink) {
  const FT_Bitmap& bitmap = glyph->bitmap;
  for (unsigned row = 0; row < bitmap.rows; ++row) {
    for (unsigned column = 0; column < bitmap.width; ++column) {
      const int x = pen + glyph->bitmap_left + static_cast<int>(column);
      const int y = baseline - glyph->bitmap_top + static_cast<int>(row);
      if (x < 0 || y < 0 || x >= ink.width || y >= ink.height) continue;
      uint8_t& to =
          ink.ink[static_cast<size_t>(y) * static_cast<size_t>(ink.width) +
                  static_cast<size_t>(x)];
      const uint8_t from =
          bitmap.buffer[row * static_cast<unsigned>(bitmap.pitch) + column];
      to = std::max(to, from);
    }
  }
}

}  // namespace

InkCoverage CaptionFont::Rasterize(std::string_view text, int pixels) const {
  InkCoverage ink;
  if (!available()) return ink;
  const std::lock_guard lock(impl_->mutex);
  const int size = std::clamp(pixels, 4, 500);
  FT_Set_Pixel_Sizes(impl_->face, 0, static_cast<FT_UInt>(size));
  const FT_Size_Metrics& metrics = impl_->face->size->metrics;
  const int baseline = static_cast<int>(metrics.ascender / 64);
  ink.height = baseline - static_cast<int>(metrics.descender / 64) + 1;
  std::vector<uint32_t> codes;
  for (size_t at = 0; at < text.size();) {
    const uint32_t code = NextCodePoint(text, at);
    if (code >= 0x20) codes.push_back(code);
  }
  for (const bool draw : {false, true}) {
    int pen = 0;
    for (const uint32_t code : codes) {
      if (FT_Load_Char(impl_->face, code,
                       FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) {
        continue;
      }
      if (draw) CopyGlyph(impl_->face->glyph, pen, baseline, ink);
      pen += static_cast<int>(impl_->face->glyph->advance.x / 64);
    }
    if (draw) break;
    ink.width = pen;
    ink.ink.assign(
        static_cast<size_t>(ink.width) * static_cast<size_t>(ink.height), 0);
  }
  return ink;
}

#else

struct CaptionFont::Impl {};
CaptionFont::CaptionFont(const std::string&) {}
CaptionFont::~CaptionFont() = default;
bool CaptionFont::available() const { return false; }
InkCoverage CaptionFont::Rasterize(std::string_view, int) const { return {}; }

#endif

const CaptionFont& CaptionFont::Default() {
  static const CaptionFont font(FindFont());
  return font;
}

bool CaptionFont::Draw(Image& image, const PixelBox& box, std::string_view text,
                       const CaptionStyle& style) const {
  if (text.empty()) return true;
  if (!available()) return false;
  const int along = style.upward ? box.height : box.width;
  const int across = style.upward ? box.width : box.height;
  std::string shown(text);
  InkCoverage ink = Rasterize(shown, style.pixels);
  while (ink.width > along && !shown.empty()) {
    shown = Shorten(shown);
    ink = Rasterize(shown, style.pixels);
  }
  const int inset = (across - ink.height) / 2;
  if (style.upward) {
    const int from_bottom = Slack(along, ink.width, style.align);
    BlendInk(image, box.x + inset, box.y + box.height - from_bottom - ink.width,
             ink, style);
  } else {
    BlendInk(image, box.x + Slack(along, ink.width, style.align), box.y + inset,
             ink, style);
  }
  return true;
}

}  // namespace argmesh
