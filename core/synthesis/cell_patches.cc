#include "core/synthesis/cell_patches.h"

#include <cstddef>
#include <vector>

namespace argmesh {
namespace {

// Number of the edge along `axis` that starts at `corner` or ends there.
int EdgeAt(int corner, int axis) {
  const int u = corner >> ((axis + 1) % 3) & 1;
  const int v = corner >> ((axis + 2) % 3) & 1;
  return 4 * axis + u + 2 * v;
}

class Tracer {
 public:
  explicit Tracer(uint8_t inside) : inside_(inside) {
    for (int edge = 0; edge < 12; ++edge) {
      leader_[static_cast<size_t>(edge)] = edge;
    }
  }

  CellPatches Trace() {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) JoinOnFace(axis, side);
    }
    CellPatches patches;
    patches.patch_of_edge.fill(-1);
    std::array<int32_t, 12> patch_of_leader;
    patch_of_leader.fill(-1);
    for (int edge = 0; edge < 12; ++edge) {
      if (!Crossed(edge)) continue;
      int32_t& patch = patch_of_leader[static_cast<size_t>(Leader(edge))];
      if (patch < 0) patch = patches.num_patches++;
      patches.patch_of_edge[static_cast<size_t>(edge)] = patch;
    }
    return patches;
  }

 private:
  bool Inside(int corner) const { return (inside_ >> corner & 1) != 0; }
  bool Crossed(int edge) const {
    const int corner = EdgeCorner(edge);
    return Inside(corner) != Inside(corner | 1 << (edge / 4));
  }
  int Leader(int edge) const {
    while (leader_[static_cast<size_t>(edge)] != edge) {
      edge = leader_[static_cast<size_t>(edge)];
    }
    return edge;
  }
  void Join(int edge, int other) {
    leader_[static_cast<size_t>(Leader(edge))] = Leader(other);
  }

  void JoinOnFace(int axis, int side) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const int base = side << axis;
    const std::array<int, 4> corners = {base, base | 1 << u, base | 1 << v,
                                        base | 1 << u | 1 << v};
    std::vector<int> crossed;
    for (const int edge : {EdgeAt(corners[0], u), EdgeAt(corners[3], u),
                           EdgeAt(corners[0], v), EdgeAt(corners[3], v)}) {
      if (Crossed(edge)) crossed.push_back(edge);
    }
    if (crossed.size() == 2) Join(crossed[0], crossed[1]);
    if (crossed.size() != 4) return;
    for (const int corner : corners) {
      if (Inside(corner)) Join(EdgeAt(corner, u), EdgeAt(corner, v));
    }
  }

  uint8_t inside_;
  std::array<int, 12> leader_;
};

std::array<CellPatches, 256> MakeTable() {
  std::array<CellPatches, 256> table;
  for (size_t i = 0; i < table.size(); ++i) {
    table[i] = Tracer(static_cast<uint8_t>(i)).Trace();
  }
  return table;
}

}  // namespace

int EdgeCorner(int edge) {
  const int axis = edge / 4;
  return (edge & 1) << ((axis + 1) % 3) | (edge >> 1 & 1) << ((axis + 2) % 3);
}

const CellPatches& PatchesOfCell(uint8_t inside) {
  static const std::array<CellPatches, 256> table = MakeTable();
  return table[inside];
}

}  // namespace argmesh
