#include "core/mesh/mesh_count.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/base/disjoint_sets.h"

namespace argmesh {
namespace {

void CountBoundingBox(const TriangleMesh& mesh, MeshReport& report) {
  if (mesh.num_faces() == 0) return;
  Eigen::Vector3d low = mesh.vertex(mesh.F(0, 0));
  Eigen::Vector3d high = low;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d x = mesh.vertex(mesh.F(f, c));
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    report.bounding_box_min[axis] = low[axis];
    report.bounding_box_max[axis] = high[axis];
  }
}

int64_t CountComponents(const TriangleMesh& mesh) {
  std::vector<int32_t> parent(Slot(mesh.num_vertices()));
  for (int32_t v = 0; v < mesh.num_vertices(); ++v) parent[Slot(v)] = v;
  int64_t components = mesh.num_vertices();
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int c = 1; c < 3; ++c) {
      const int32_t a = FindRoot(parent, mesh.F(f, 0));
      const int32_t b = FindRoot(parent, mesh.F(f, c));
      if (a == b) continue;
      parent[Slot(std::max(a, b))] = std::min(a, b);
      --components;
    }
  }
  return components;
}

// The side that leaves `v` among the two sides of `face` at it, whichever way
// the neighbours wind: corners are compared, not directions.
int32_t CornerAt(const FaceMatrix& F, int32_t face, int32_t v) {
  return 3 * face + (F(face, 0) == v ? 0 : F(face, 1) == v ? 1 : 2);
}

// Vertices on an edge of more than two faces, or with several fans.
int64_t CountNonmanifoldVertices(const TriangleMesh& mesh,
                                 const MeshEdges& edges) {
  std::vector<int32_t> parent(3 * Slot(mesh.num_faces()));
  for (size_t i = 0; i < parent.size(); ++i) {
    parent[i] = static_cast<int32_t>(i);
  }
  std::vector<char> nonmanifold(Slot(mesh.num_vertices()), 0);
  for (size_t e = 0; e < edges.size(); ++e) {
    const std::span<const int32_t> sides = edges.sides_of(e);
    for (const int32_t v : edges.ends[e]) {
      if (sides.size() > 2) nonmanifold[Slot(v)] = 1;
      if (sides.size() != 2) continue;
      const int32_t a = FindRoot(parent, CornerAt(mesh.F, sides[0] / 3, v));
      const int32_t b = FindRoot(parent, CornerAt(mesh.F, sides[1] / 3, v));
      parent[Slot(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<int32_t> fan(nonmanifold.size(), -1);
  for (int32_t corner = 0; Slot(corner) < parent.size(); ++corner) {
    const int32_t root = FindRoot(parent, corner);
    const size_t v = Slot(mesh.F(corner / 3, corner % 3));
    if (fan[v] >= 0 && fan[v] != root) nonmanifold[v] = 1;
    fan[v] = root;
  }
  return std::count(nonmanifold.begin(), nonmanifold.end(), 1);
}

}  // namespace

MeshReport CountFound(const TriangleMesh& given, const WeldedMesh& welded,
                      const MeshEdges& edges) {
  MeshReport report;
  report.vertices = given.num_vertices();
  report.faces = given.num_faces();
  report.area = welded.area;
  report.unused_vertices = welded.unused_vertices;
  report.welded_vertices = welded.welded_vertices;
  report.degenerate_faces_dropped = welded.degenerate_faces;
  report.duplicate_faces_dropped = welded.duplicate_faces;
  CountBoundingBox(given, report);
  report.components = CountComponents(welded.mesh);
  for (size_t e = 0; e < edges.size(); ++e) {
    const size_t faces = edges.sides_of(e).size();
    if (faces == 1) ++report.boundary_edges;
    if (faces > 2) ++report.nonmanifold_edges;
  }
  report.nonmanifold_vertices = CountNonmanifoldVertices(welded.mesh, edges);
  return report;
}

int64_t EulerCharacteristic(const TriangleMesh& mesh, const MeshEdges& edges) {
  return int64_t{mesh.num_vertices()} - static_cast<int64_t>(edges.size()) +
         mesh.num_faces();
}

}  // namespace argmesh
