// An 8-bit RGB picture and its PNG bytes.
//
// Repeats  equal images give equal bytes (no time stamps).
// Cost     O(pixels).
#ifndef ARGMESH_CLIENT_PICTURE_IMAGE_H_
#define ARGMESH_CLIENT_PICTURE_IMAGE_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/mesh/mesh_write.h"

namespace argmesh {

inline constexpr RgbColor kWhite = {255, 255, 255};
inline constexpr RgbColor kBlack = {0, 0, 0};
inline constexpr RgbColor kInk = {40, 44, 52};          // captions, outlines
inline constexpr RgbColor kPaleGrey = {205, 207, 210};  // unmatched surface
inline constexpr RgbColor kGood = {34, 139, 84};        // relevant result
inline constexpr RgbColor kBad = {200, 55, 50};         // wrong result

class Image {
 public:
  Image() = default;
  // Both sizes >= 0.
  Image(int width, int height, RgbColor fill = kWhite);

  int width() const { return width_; }
  int height() const { return height_; }
  // Rows top to bottom, three bytes a pixel.
  const std::vector<uint8_t>& bytes() const { return bytes_; }

  RgbColor At(int x, int y) const;
  void Set(int x, int y, RgbColor color);
  // Moves the pixel toward `color` by `share` of 0 .. 1; pixels outside the
  // image are left out.
  void Blend(int x, int y, RgbColor color, double share);

  // Pixels outside the image are left out.
  void FillRectangle(int x, int y, int width, int height, RgbColor color);
  // A frame of this many pixels inside the rectangle.
  void DrawFrame(int x, int y, int width, int height, int thickness,
                 RgbColor color);
  void Paste(const Image& other, int x, int y);

 private:
  size_t Offset(int x, int y) const;

  int width_ = 0;
  int height_ = 0;
  std::vector<uint8_t> bytes_;
};

// Fails    kInvalidArgument  an empty image, or wider or higher than 30,000
//          kInternal         libpng refuses
absl::StatusOr<std::string> SerializePng(const Image& image);

// Fails as SerializePng and kUnavailable when the file cannot be written.
absl::Status WritePng(const Image& image, const std::string& path);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_IMAGE_H_
