#include "core/mesh/vertex_weld.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace argmesh {
namespace {

struct Entry {
  double x;
  double y;
  double z;
  int32_t position;
};

bool SamePosition(const Entry& a, const Entry& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

}  // namespace

VertexWeld WeldEqualPositions(std::span<const double> coordinates) {
  const size_t count = coordinates.size() / 3;
  std::vector<Entry> entries(count);
  for (size_t i = 0; i < count; ++i) {
    entries[i] = {coordinates[3 * i], coordinates[3 * i + 1],
                  coordinates[3 * i + 2], static_cast<int32_t>(i)};
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.x, a.y, a.z, a.position) <
           std::tie(b.x, b.y, b.z, b.position);
  });

  // First the smallest equal position, which is its own; then the numbers in
  // the order of the positions.
  VertexWeld weld;
  weld.vertex_of.resize(count);
  for (size_t begin = 0; begin < count;) {
    size_t end = begin;
    for (; end < count && SamePosition(entries[begin], entries[end]); ++end) {
      weld.vertex_of[static_cast<size_t>(entries[end].position)] =
          entries[begin].position;
    }
    begin = end;
  }
  for (size_t i = 0; i < count; ++i) {
    int32_t& vertex = weld.vertex_of[i];
    const auto first = static_cast<size_t>(vertex);
    vertex = first == i ? weld.num_vertices++ : weld.vertex_of[first];
  }
  return weld;
}

}  // namespace argmesh
