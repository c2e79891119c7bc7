#include "core/mesh/mesh_edges.h"

#include <algorithm>

namespace argmesh {
namespace {

// One side under its lower end: the upper end in the high half, the side in
// the low one, so that sorting the keys sorts by edge, then side.
uint64_t PackSide(int32_t upper, int32_t side) {
  return (static_cast<uint64_t>(upper) << 32) | static_cast<uint32_t>(side);
}

struct SideEnds {
  int32_t lower;
  int32_t upper;
};

SideEnds EndsOfSide(const FaceMatrix& F, int face, int corner) {
  const int32_t a = F(face, corner);
  const int32_t b = F(face, (corner + 1) % 3);
  return {std::min(a, b), std::max(a, b)};
}

void AppendEdges(int32_t lower, std::span<const uint64_t> keys,
                 MeshEdges& edges) {
  for (size_t i = 0; i < keys.size(); ++i) {
    const auto upper = static_cast<int32_t>(keys[i] >> 32);
    if (i == 0 || upper != static_cast<int32_t>(keys[i - 1] >> 32)) {
      edges.ends.push_back({lower, upper});
      edges.offsets.push_back(static_cast<int32_t>(edges.sides.size()));
    }
    edges.sides.push_back(static_cast<int32_t>(keys[i] & 0xffffffffU));
  }
}

}  // namespace

MeshEdges ComputeMeshEdges(const FaceMatrix& F, int num_vertices) {
  const int num_faces = static_cast<int>(F.rows());
  std::vector<int32_t> starts(Slot(num_vertices) + 1, 0);
  for (int f = 0; f < num_faces; ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      const SideEnds ends = EndsOfSide(F, f, corner);
      if (ends.lower != ends.upper) ++starts[Slot(ends.lower) + 1];
    }
  }
  for (size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<uint64_t> keys(Slot(starts.back()));
  std::vector<int32_t> next = starts;
  for (int f = 0; f < num_faces; ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      const SideEnds ends = EndsOfSide(F, f, corner);
      if (ends.lower == ends.upper) continue;
      keys[Slot(next[Slot(ends.lower)]++)] =
          PackSide(ends.upper, 3 * f + corner);
    }
  }
  MeshEdges edges;
  edges.ends.reserve(keys.size() / 2 + 1);
  edges.offsets.reserve(keys.size() / 2 + 2);
  edges.sides.reserve(keys.size());
  for (int32_t v = 0; v < num_vertices; ++v) {
    const std::span<uint64_t> row(keys.data() + starts[Slot(v)],
                                  keys.data() + starts[Slot(v) + 1]);
    std::sort(row.begin(), row.end());
    AppendEdges(v, row, edges);
  }
  edges.offsets.push_back(static_cast<int32_t>(edges.sides.size()));
  return edges;
}

std::vector<int32_t> ComputeTwins(const MeshEdges& edges, int num_faces) {
  std::vector<int32_t> twins(3 * Slot(num_faces), -1);
  for (size_t e = 0; e < edges.size(); ++e) {
    const std::span<const int32_t> sides = edges.sides_of(e);
    if (sides.size() != 2) continue;
    twins[Slot(sides[0])] = sides[1];
    twins[Slot(sides[1])] = sides[0];
  }
  return twins;
}

}  // namespace argmesh
