// Signed distances of an implicit surface on a regular grid, evaluated only in
// the blocks of 4 x 4 x 4 corners that the surface passes.
//
// Far blocks are skipped because a distance changes no faster than the way
// walked; where that bound should fail, blocks whose sign disagrees with a
// neighbour's are added until none does, so no surface ends in mid-air.
//
// Cost     O(blocks of 16 cells) + O(surface / cell^2) primitive distances.
#ifndef ARGMESH_CORE_SYNTHESIS_SURFACE_GRID_H_
#define ARGMESH_CORE_SYNTHESIS_SURFACE_GRID_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/synthesis/implicit_surface.h"

namespace argmesh {

// A corner of the grid, or the cell above it in every axis.
using GridCorner = std::array<int, 3>;

class SurfaceGrid {
 public:
  static constexpr int kBlock = 4;

  // `surface` must outlive the grid; cell > 0 is the length of a cell's edge.
  SurfaceGrid(const ImplicitSurface& surface, double cell);

  double cell() const { return cell_; }
  Eigen::Vector3d Position(const GridCorner& corner) const;
  // Never 0. Outside evaluated blocks the sign alone is right.
  float Value(const GridCorner& corner) const;
  bool Inside(const GridCorner& corner) const { return Value(corner) < 0; }

  // Low corners of the evaluated blocks, ascending in z, y, x.
  const std::vector<GridCorner>& blocks() const { return blocks_; }
  // The primitives that matter in the block of this corner, all of them
  // outside evaluated blocks.
  std::span<const int32_t> Terms(const GridCorner& corner) const;
  // A number that no other corner has.
  int64_t Key(const GridCorner& corner) const;
  // Area by the volume of the band within half a cell of the surface.
  double EstimateArea() const;

 private:
  struct Block {
    std::array<float, size_t{kBlock} * kBlock * kBlock> values;
    std::vector<int32_t> terms;
  };
  size_t BlockNumber(const GridCorner& block) const;
  bool Contains(const GridCorner& block) const;
  void VisitCoarseBlock(const GridCorner& coarse);
  void VisitBlock(const GridCorner& block, std::span<const int32_t> terms);
  void EvaluateBlock(const GridCorner& block, std::vector<int32_t> terms);
  void GrowToClosure();
  bool DisagreesWithNeighbor(const GridCorner& block, int axis, int side) const;
  void SortBlocks();

  const ImplicitSurface& surface_;
  double cell_;
  Eigen::Vector3d origin_;
  GridCorner size_;  // in blocks
  std::vector<int32_t> all_terms_;
  std::vector<int32_t> slot_;  // of each block; -1 when not evaluated
  std::vector<int8_t> sign_;   // of blocks that are not
  std::vector<Block> stored_;
  std::vector<GridCorner> blocks_;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_SURFACE_GRID_H_
