#include "core/mesh/mesh_smooth.h"

#include <cmath>
#include <vector>

#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_weld.h"

namespace argmesh {
namespace {

struct VertexRings {
  Adjacency neighbors;         // by vertex number in each row
  std::vector<char> boundary;  // by vertex
};

VertexRings ComputeRings(const TriangleMesh& mesh) {
  const MeshEdges edges = ComputeMeshEdges(mesh.F, mesh.num_vertices());
  VertexRings rings;
  rings.boundary.assign(Slot(mesh.num_vertices()), 0);
  std::vector<int32_t>& offsets = rings.neighbors.offsets;
  offsets.assign(Slot(mesh.num_vertices()) + 1, 0);
  for (size_t e = 0; e < edges.size(); ++e) {
    for (const int32_t v : edges.ends[e]) {
      ++offsets[Slot(v) + 1];
      if (edges.sides_of(e).size() == 1) rings.boundary[Slot(v)] = 1;
    }
  }
  for (size_t v = 1; v < offsets.size(); ++v) offsets[v] += offsets[v - 1];
  rings.neighbors.items.resize(Slot(offsets.back()));
  // Sorted edges fill a row first with the lower neighbours, then the upper
  // ones, when the upper ends are placed in a pass of their own.
  std::vector<int32_t> next = offsets;
  for (const auto& [a, b] : edges.ends) {
    rings.neighbors.items[Slot(next[Slot(b)]++)] = a;
  }
  for (const auto& [a, b] : edges.ends) {
    rings.neighbors.items[Slot(next[Slot(a)]++)] = b;
  }
  return rings;
}

// One step towards (or with a negative factor away from) the neighbours' mean.
void Step(const VertexRings& rings, double factor, const VertexMatrix& from,
          VertexMatrix& to) {
  for (Eigen::Index v = 0; v < from.rows(); ++v) {
    const size_t row = static_cast<size_t>(v);
    const int32_t begin = rings.neighbors.offsets[row];
    const int32_t end = rings.neighbors.offsets[row + 1];
    to.row(v) = from.row(v);
    if (rings.boundary[row] || begin == end) continue;
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (int32_t i = begin; i < end; ++i) {
      sum += from.row(rings.neighbors.items[Slot(i)]);
    }
    to.row(v) += factor * (sum / (end - begin) - from.row(v));
  }
}

}  // namespace

void SmoothTaubin(TriangleMesh& mesh, const TaubinOptions& options) {
  if (options.steps <= 0) return;
  const VertexRings rings = ComputeRings(mesh);
  VertexMatrix other(mesh.V.rows(), 3);
  for (int step = 0; step < options.steps; ++step) {
    Step(rings, options.lambda, mesh.V, other);
    Step(rings, options.mu, other, mesh.V);
  }
}

UnitAreaTransform NormalizeToUnitArea(TriangleMesh& mesh) {
  // Sums are taken about one vertex so that a mesh far from the origin keeps
  // its digits.
  const Eigen::Vector3d origin = mesh.vertex(mesh.F(0, 0));
  double area = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const double face_area = FaceCross(mesh, f).norm() / 2;
    area += face_area;
    moment += face_area / 3 *
              (mesh.vertex(mesh.F(f, 0)) + mesh.vertex(mesh.F(f, 1)) +
               mesh.vertex(mesh.F(f, 2)) - 3 * origin);
  }
  UnitAreaTransform transform;
  transform.centroid = origin + moment / area;
  transform.scale = 1 / std::sqrt(area);
  mesh.V.rowwise() -= transform.centroid.transpose();
  mesh.V *= transform.scale;
  return transform;
}

}  // namespace argmesh
