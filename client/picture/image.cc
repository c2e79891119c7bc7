#include "client/picture/image.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr int kMaxSide = 30'000;

uint8_t Mix(uint8_t from, uint8_t to, double share) {
  return static_cast<uint8_t>(std::lround(from + share * (to - from)));
}

}  // namespace

Image::Image(int width, int height, RgbColor fill)
    : width_(width), height_(height) {
  bytes_.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * 3);
  FillRectangle(0, 0, width, height, fill);
}

size_t Image::Offset(int x, int y) const {
  return (static_cast<size_t>(y) * static_cast<size_t>(width_) +
          static_cast<size_t>(x)) *
         3;
}

RgbColor Image::At(int x, int y) const {
  const size_t at = Offset(x, y);
  return {bytes_[at], bytes_[at + 1], bytes_[at + 2]};
}

void Image::Set(int x, int y, RgbColor color) {
  const size_t at = Offset(x, y);
  std::copy(color.begin(), color.end(),
            bytes_.begin() + static_cast<ptrdiff_t>(at));
}

void Image::Blend(int x, int y, RgbColor color, double share) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  const size_t at = Offset(x, y);
  for (size_t c = 0; c < 3; ++c) {
    bytes_[at + c] = Mix(bytes_[at + c], color[c], std::clamp(share, 0.0, 1.0));
  }
}

void Image::FillRectangle(int x, int y, int width, int height, RgbColor color) {
  for (int j = std::max(y, 0); j < std::min(y + height, height_); ++j) {
    for (int i = std::max(x, 0); i < std::min(x + width, width_); ++i) {
      Set(i, j, color);
    }
  }
}

void Image::DrawFrame(int x, int y, int width, int height, int thickness,
                      RgbColor color) {
  FillRectangle(x, y, width, thickness, color);
  FillRectangle(x, y + height - thickness, width, thickness, color);
  FillRectangle(x, y, thickness, height, color);
  FillRectangle(x + width - thickness, y, thickness, height, color);
}

void Image::Paste(const Image& other, int x, int y) {
  for (int j = std::max(-y, 0); j < std::min(other.height_, height_ - y); ++j) {
    for (int i = std::max(-x, 0); i < std::min(other.width_, width_ - x); ++i) {
      Set(x + i, y + j, other.At(i, j));
    }
  }
}

absl::StatusOr<std::string> SerializePng(const Image& image) {
  if (image.width() < 1 || image.height() < 1 || image.width() > kMaxSide ||
      image.height() > kMaxSide) {
    return absl::InvalidArgumentError(
        absl::StrFormat("image of %d x %d pixels is outside 1 .. %d",
                        image.width(), image.height(), kMaxSide));
  }
  png_image png = {};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width());
  png.height = static_cast<png_uint_32>(image.height());
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0,
                                image.bytes().data(), 0, nullptr) == 0) {
    return absl::InternalError(
        absl::StrFormat("libpng: %s", std::string(png.message)));
  }
  bytes.resize(size);
  return bytes;
}

absl::Status WritePng(const Image& image, const std::string& path) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string bytes, SerializePng(image));
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    return absl::UnavailableError(absl::StrFormat("cannot write \"%s\"", path));
  }
  return absl::OkStatus();
}

}  // namespace argmesh
