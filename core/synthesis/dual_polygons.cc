#include "core/synthesis/dual_polygons.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "core/synthesis/cell_patches.h"

namespace argmesh {
namespace {

GridCorner Step(GridCorner corner, int axis, int by) {
  corner[static_cast<size_t>(axis)] += by;
  return corner;
}

class DualBuilder {
 public:
  explicit DualBuilder(const SurfaceGrid& grid) : grid_(grid) {
    first_vertex_.reserve(grid.blocks().size() * 32);
  }

  DualPolygons Build() && {
    constexpr int kBlock = SurfaceGrid::kBlock;
    for (const GridCorner& block : grid_.blocks()) {
      for (int i = 0; i < kBlock * kBlock * kBlock; ++i) {
        VisitCorner({block[0] + i % kBlock, block[1] + i / kBlock % kBlock,
                     block[2] + i / (kBlock * kBlock)});
      }
    }
    return std::move(polygons_);
  }

 private:
  void VisitCorner(const GridCorner& corner) {
    const bool inside = grid_.Inside(corner);
    for (int axis = 0; axis < 3; ++axis) {
      if (grid_.Inside(Step(corner, axis, 1)) != inside) {
        AddPolygon(corner, axis);
      }
    }
  }

  // The four cells around the edge, and between each two of them a vertex on
  // their common face where that face is crossed by two sheets.
  void AddPolygon(const GridCorner& corner, int axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    constexpr std::array<std::array<int, 2>, 4> kCells = {
        {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
    const std::array<std::array<int, 2>, 4> toward = {
        {{v, 1}, {u, -1}, {v, -1}, {u, 1}}};
    std::vector<int32_t>& corners = polygons_.corners;
    const size_t begin = corners.size();
    for (size_t i = 0; i < 4; ++i) {
      const GridCorner cell =
          Step(Step(corner, u, kCells[i][0]), v, kCells[i][1]);
      const int edge = 4 * axis - kCells[i][0] - 2 * kCells[i][1];
      corners.push_back(PatchVertex(cell, edge));
      const int32_t between =
          FaceVertex(corner, axis, toward[i][0], toward[i][1]);
      if (between >= 0) corners.push_back(between);
    }
    if (!grid_.Inside(corner)) {
      std::reverse(corners.begin() + static_cast<ptrdiff_t>(begin),
                   corners.end());
    }
    polygons_.offsets.push_back(static_cast<int32_t>(corners.size()));
  }

  GridCorner CellCorner(const GridCorner& cell, int c) const {
    return {cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2 & 1)};
  }

  const CellPatches& Patches(const GridCorner& cell) const {
    unsigned inside = 0;
    for (int c = 0; c < 8; ++c) {
      if (grid_.Inside(CellCorner(cell, c))) inside |= 1U << c;
    }
    return PatchesOfCell(static_cast<uint8_t>(inside));
  }

  int32_t PatchVertex(const GridCorner& cell, int edge) {
    const CellPatches& patches = Patches(cell);
    const auto [it, is_new] = first_vertex_.try_emplace(
        grid_.Key(cell), static_cast<int32_t>(polygons_.positions.size()));
    if (is_new) AddPatchVertices(cell, patches);
    return it->second + patches.patch_of_edge[static_cast<size_t>(edge)];
  }

  void AddPatchVertices(const GridCorner& cell, const CellPatches& patches) {
    std::array<Eigen::Vector3d, 4> sums;
    sums.fill(Eigen::Vector3d::Zero());
    std::array<int, 4> counts = {0, 0, 0, 0};
    for (int edge = 0; edge < 12; ++edge) {
      const int patch = patches.patch_of_edge[static_cast<size_t>(edge)];
      if (patch < 0) continue;
      const auto p = static_cast<size_t>(patch);
      sums[p] += Crossing(CellCorner(cell, EdgeCorner(edge)), edge / 4);
      ++counts[p];
    }
    for (size_t p = 0; p < static_cast<size_t>(patches.num_patches); ++p) {
      AddVertex(sums[p] / counts[p], cell);
    }
  }

  // Between the cells on both sides of the face that holds the edge at
  // `corner` along `axis` and extends toward `side` on axis `across`; -1 when
  // only one sheet crosses the face.
  int32_t FaceVertex(const GridCorner& corner, int axis, int across, int side) {
    const GridCorner end = Step(corner, axis, 1);
    const bool inside = grid_.Inside(corner);
    if (grid_.Inside(Step(corner, across, side)) == inside ||
        grid_.Inside(Step(end, across, side)) != inside) {
      return -1;
    }
    // The sheet cuts off the inside end of the edge.
    const GridCorner cut_off = inside ? corner : end;
    const GridCorner other = Step(cut_off, across, side);
    const int64_t normal_axis = 3 - axis - across;
    const GridCorner other_low = side < 0 ? other : cut_off;
    GridCorner low = corner;
    if (side < 0) low = Step(low, across, -1);
    // The two inside corners of such a face differ on both of its axes: one
    // coordinate tells its two sheets apart.
    const auto first = static_cast<size_t>((normal_axis + 1) % 3);
    const int64_t key = (grid_.Key(low) * 3 + normal_axis) * 2 +
                        (cut_off[first] != low[first] ? 1 : 0);
    const auto [it, is_new] = face_vertex_.try_emplace(
        key, static_cast<int32_t>(polygons_.positions.size()));
    if (is_new) {
      AddVertex(0.5 * (Crossing(corner, axis) + Crossing(other_low, across)),
                low);
    }
    return it->second;
  }

  Eigen::Vector3d Crossing(const GridCorner& low, int axis) const {
    const GridCorner high = Step(low, axis, 1);
    const double v0 = grid_.Value(low);
    const double v1 = grid_.Value(high);
    const double t = std::clamp(v0 / (v0 - v1), 0.05, 0.95);
    return (1 - t) * grid_.Position(low) + t * grid_.Position(high);
  }

  void AddVertex(const Eigen::Vector3d& position, const GridCorner& cell) {
    polygons_.positions.push_back(position);
    polygons_.cells.push_back(cell);
  }

  const SurfaceGrid& grid_;
  DualPolygons polygons_;
  std::unordered_map<int64_t, int32_t> first_vertex_;
  std::unordered_map<int64_t, int32_t> face_vertex_;
};

}  // namespace

DualPolygons BuildDualPolygons(const SurfaceGrid& grid) {
  return DualBuilder(grid).Build();
}

}  // namespace argmesh
