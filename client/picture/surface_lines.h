// Thin dark lines where neighbouring subpixels show different colours of
// surface, the edge of the shape, or a part far behind another.
#ifndef ARGMESH_CLIENT_PICTURE_SURFACE_LINES_H_
#define ARGMESH_CLIENT_PICTURE_SURFACE_LINES_H_

#include <cstdint>
#include <vector>

#include "client/picture/image.h"

namespace argmesh {

// What every subpixel shows.
class SubpixelGrid {
 public:
  static constexpr int kSub = 3;  // along a pixel's side

  struct Subpixel {
    int32_t key = -1;  // -1 for the background
    float z = 0;       // nearer is larger, pixels
  };

  SubpixelGrid(int width, int height);

  // Subpixel `i` of the pixel, row by row.
  void Set(int x, int y, int i, Subpixel subpixel);
  void Fill(int x, int y, int32_t key, float z);

  // Whether all subpixels of the pixel show the same at one depth.
  bool IsPlain(int x, int y) const { return plain_[Pixel(x, y)] != 0; }
  // Subpixel coordinates, clamped to the grid.
  const Subpixel& At(int column, int row) const;

 private:
  size_t Pixel(int x, int y) const;

  int width_;
  int height_;
  std::vector<Subpixel> subpixels_;
  std::vector<uint8_t> plain_;
};

// Darkens the pixels of row y.
void DrawLinesOfRow(const SubpixelGrid& grid, int y, Image& image);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_SURFACE_LINES_H_
