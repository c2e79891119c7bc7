#include "core/mesh/mesh_fans.h"

#include <algorithm>
#include <array>

#include "core/mesh/mesh_edges.h"

namespace argmesh {
namespace {

// Side s leaves the vertex at its start, so it also stands for that corner of
// its face. These are its neighbours around the vertex, or -1.
int32_t CornerCounterClockwise(const std::vector<int32_t>& twins, int32_t s) {
  return twins[Slot(PrevSide(s))];
}
int32_t CornerClockwise(const std::vector<int32_t>& twins, int32_t s) {
  const int32_t twin = twins[Slot(s)];
  return twin < 0 ? -1 : NextSide(twin);
}

// Gives `vertex` to all corners of the fan of corner `first`.
void NameFan(const std::vector<int32_t>& twins, int32_t first, int32_t vertex,
             std::vector<int32_t>& vertex_of_corner) {
  int32_t corner = first;
  do {
    vertex_of_corner[Slot(corner)] = vertex;
    corner = CornerCounterClockwise(twins, corner);
  } while (corner >= 0 && corner != first);
  if (corner == first) return;
  corner = CornerClockwise(twins, first);
  while (corner >= 0) {
    vertex_of_corner[Slot(corner)] = vertex;
    corner = CornerClockwise(twins, corner);
  }
}

// The two ends of one fan can lie on one edge. No other two sides of equal
// ends are left: the fan of their start would need two clockwise ends.
void JoinSlits(const FaceMatrix& F, std::vector<int32_t>& twins) {
  std::vector<std::array<int32_t, 3>> open;  // lower end, upper end, side
  for (int32_t side = 0; Slot(side) < twins.size(); ++side) {
    if (twins[Slot(side)] >= 0) continue;
    const int32_t next = NextSide(side);
    const int32_t a = F(side / 3, side % 3);
    const int32_t b = F(next / 3, next % 3);
    open.push_back({std::min(a, b), std::max(a, b), side});
  }
  std::sort(open.begin(), open.end());
  for (size_t i = 1; i < open.size(); ++i) {
    if (open[i][0] != open[i - 1][0] || open[i][1] != open[i - 1][1]) continue;
    twins[Slot(open[i][2])] = open[i - 1][2];
    twins[Slot(open[i - 1][2])] = open[i][2];
  }
}

}  // namespace

int64_t SplitFans(TriangleMesh& mesh, std::vector<int32_t>& twins) {
  const int num_vertices = mesh.num_vertices();
  std::vector<char> seen(Slot(num_vertices), 0);
  std::vector<int32_t> vertex_of_corner(twins.size(), -1);
  std::vector<int32_t> copied;
  for (int32_t corner = 0; Slot(corner) < twins.size(); ++corner) {
    if (vertex_of_corner[Slot(corner)] >= 0) continue;
    const int32_t v = mesh.F(corner / 3, corner % 3);
    int32_t name = v;
    if (seen[Slot(v)]) {
      name = num_vertices + static_cast<int32_t>(copied.size());
      copied.push_back(v);
    }
    seen[Slot(v)] = 1;
    NameFan(twins, corner, name, vertex_of_corner);
  }
  mesh.V.conservativeResize(
      num_vertices + static_cast<Eigen::Index>(copied.size()), 3);
  for (size_t i = 0; i < copied.size(); ++i) {
    mesh.V.row(num_vertices + static_cast<Eigen::Index>(i)) =
        mesh.V.row(copied[i]);
  }
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      mesh.F(f, c) = vertex_of_corner[Slot(3 * f + c)];
    }
  }
  JoinSlits(mesh.F, twins);
  return static_cast<int64_t>(copied.size());
}

}  // namespace argmesh
