// What a closed triangle mesh is like, counted independently of the library.
#ifndef ARGMESH_TESTS_UNIT_CORE_SYNTHESIS_CLOSED_SURFACE_H_
#define ARGMESH_TESTS_UNIT_CORE_SYNTHESIS_CLOSED_SURFACE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct SurfaceCounts {
  int unpaired_halfedges = 0;  // without exactly one opposite
  int broken_fans = 0;         // vertices whose faces are not one cycle
  int components = 0;
  int euler = 0;
};

inline int CountBrokenFans(const TriangleMesh& mesh) {
  // The edges opposite to a vertex must form one cycle.
  std::vector<std::map<int, int>> next(
      static_cast<size_t>(mesh.num_vertices()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      next[static_cast<size_t>(mesh.F(f, k))][mesh.F(f, (k + 1) % 3)] =
          mesh.F(f, (k + 2) % 3);
    }
  }
  int broken = 0;
  for (const auto& link : next) {
    if (link.empty()) {
      ++broken;
      continue;
    }
    const int start = link.begin()->first;
    int at = start;
    size_t steps = 0;
    do {
      const auto it = link.find(at);
      if (it == link.end()) break;
      at = it->second;
      ++steps;
    } while (at != start && steps <= link.size());
    if (at != start || steps != link.size()) ++broken;
  }
  return broken;
}

inline SurfaceCounts CountSurface(const TriangleMesh& mesh) {
  SurfaceCounts counts;
  std::map<std::pair<int, int>, int> halfedges;
  std::set<std::pair<int, int>> edges;
  std::vector<int> leader(static_cast<size_t>(mesh.num_vertices()));
  for (size_t i = 0; i < leader.size(); ++i) leader[i] = static_cast<int>(i);
  const auto find = [&leader](int v) {
    while (leader[static_cast<size_t>(v)] != v) {
      v = leader[static_cast<size_t>(v)] =
          leader[static_cast<size_t>(leader[static_cast<size_t>(v)])];
    }
    return v;
  };
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.F(f, k);
      const int b = mesh.F(f, (k + 1) % 3);
      ++halfedges[{a, b}];
      edges.insert(std::minmax(a, b));
      leader[static_cast<size_t>(find(a))] = find(b);
    }
  }
  for (const auto& [edge, count] : halfedges) {
    const auto opposite = halfedges.find({edge.second, edge.first});
    if (count != 1 || opposite == halfedges.end() || opposite->second != 1) {
      ++counts.unpaired_halfedges;
    }
  }
  std::set<int> roots;
  for (int v = 0; v < mesh.num_vertices(); ++v) roots.insert(find(v));
  counts.components = static_cast<int>(roots.size());
  counts.broken_fans = CountBrokenFans(mesh);
  counts.euler =
      mesh.num_vertices() - static_cast<int>(edges.size()) + mesh.num_faces();
  return counts;
}

inline double SurfaceArea(const TriangleMesh& mesh) {
  double area = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d a = mesh.vertex(mesh.F(f, 0));
    area += 0.5 * (mesh.vertex(mesh.F(f, 1)) - a)
                      .cross(mesh.vertex(mesh.F(f, 2)) - a)
                      .norm();
  }
  return area;
}

// Positive when faces are counter-clockwise from outside.
inline double SignedVolume(const TriangleMesh& mesh) {
  double volume = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    volume +=
        mesh.vertex(mesh.F(f, 0))
            .dot(mesh.vertex(mesh.F(f, 1)).cross(mesh.vertex(mesh.F(f, 2)))) /
        6;
  }
  return volume;
}

}  // namespace argmesh

#endif  // ARGMESH_TESTS_UNIT_CORE_SYNTHESIS_CLOSED_SURFACE_H_
