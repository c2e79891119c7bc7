// How a surface passes through one cube of a grid: which of its edges belong
// to the same sheet.
//
// Source   Nielson, "Dual Marching Cubes", IEEE Visualization 2004. A face
//          with crossed signs always keeps its inside corners apart, so that
//          the two cubes at a face agree.
#ifndef ARGMESH_CORE_SYNTHESIS_CELL_PATCHES_H_
#define ARGMESH_CORE_SYNTHESIS_CELL_PATCHES_H_

#include <array>
#include <cstdint>

namespace argmesh {

// Corner c has coordinates (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 a + i runs
// along axis a; bit 0 of i is its place on axis (a + 1) % 3, bit 1 the one on
// axis (a + 2) % 3.
struct CellPatches {
  std::array<int32_t, 12> patch_of_edge;  // -1: the edge is not crossed
  int32_t num_patches = 0;                // 0 .. 4
};

// The corner at the low end of an edge.
int EdgeCorner(int edge);

// `inside` has bit c set when corner c is inside. Cost O(1) after first use.
const CellPatches& PatchesOfCell(uint8_t inside);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_CELL_PATCHES_H_
