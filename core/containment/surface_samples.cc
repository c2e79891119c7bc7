#include "core/containment/surface_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/disjoint_sets.h"
#include "core/base/random.h"
#include "core/geometry/area.h"
#include "core/mesh/mesh_edges.h"

namespace argmesh {
namespace {

constexpr double kBoundaryStep = 0.01;
constexpr float kPinhole = 0.25F;  // of a window's radius

// The lowest vertex at each vertex's position.
std::vector<int32_t> FirstAtPosition(const TriangleMesh& mesh) {
  std::vector<int32_t> order(Slot(mesh.num_vertices()));
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int32_t v) {
    return std::array<double, 3>{mesh.V(v, 0), mesh.V(v, 1), mesh.V(v, 2)};
  };
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return std::pair(key(a), a) < std::pair(key(b), b);
  });
  std::vector<int32_t> first(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    first[Slot(order[i])] = same ? first[Slot(order[i - 1])] : order[i];
  }
  return first;
}

using Edge = std::array<int32_t, 2>;

std::vector<Edge> OpenEdges(const TriangleMesh& mesh) {
  const MeshEdges edges = ComputeMeshEdges(mesh.F, mesh.num_vertices());
  std::vector<Edge> boundary;
  for (size_t e = 0; e < edges.size(); ++e) {
    if (edges.sides_of(e).size() == 1) boundary.push_back(edges.ends[e]);
  }
  if (boundary.empty()) return boundary;
  const std::vector<int32_t> first = FirstAtPosition(mesh);
  for (Edge& edge : boundary) {
    edge = {first[Slot(edge[0])], first[Slot(edge[1])]};
    if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
  }
  std::sort(boundary.begin(), boundary.end());
  std::vector<Edge> open;
  for (size_t i = 0; i < boundary.size();) {
    size_t end = i + 1;
    while (end < boundary.size() && boundary[end] == boundary[i]) ++end;
    if (end == i + 1) open.push_back(boundary[i]);
    i = end;
  }
  return open;
}

}  // namespace

TriangleMesh ToUnitArea(const TriangleMesh& mesh, const Eigen::VectorXd& areas,
                        WindowFrame& frame) {
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  for (int f = 0; f < mesh.num_faces(); ++f) {
    weighted += areas[f] / 3 *
                (mesh.vertex(mesh.F(f, 0)) + mesh.vertex(mesh.F(f, 1)) +
                 mesh.vertex(mesh.F(f, 2)));
  }
  const double total = areas.sum();
  frame.origin = weighted / total;
  frame.scale = 1 / std::sqrt(total);
  TriangleMesh unit;
  unit.V = (mesh.V.rowwise() - frame.origin.transpose()) * frame.scale;
  unit.F = mesh.F;
  return unit;
}

SurfaceSamples SampleSurface(const TriangleMesh& mesh,
                             const Eigen::VectorXd& areas, int count,
                             uint64_t seed) {
  Random random(seed);
  const VertexMatrix corner_normals = ComputeVertexNormals(mesh);
  const double step = areas.sum() / count;
  double next = step * random.Uniform();
  double passed = 0;
  SurfaceSamples ordered;
  ordered.positions.reserve(static_cast<size_t>(count) + 1);
  ordered.normals.reserve(static_cast<size_t>(count) + 1);
  ordered.faces.reserve(static_cast<size_t>(count) + 1);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    passed += areas[f];
    if (passed <= next) continue;
    const Eigen::RowVector3i face = mesh.F.row(f);
    const Eigen::Vector3d a = mesh.vertex(face[0]);
    const Eigen::Vector3d b = mesh.vertex(face[1]);
    const Eigen::Vector3d c = mesh.vertex(face[2]);
    const Eigen::Vector3d face_normal = (b - a).cross(c - a).normalized();
    while (next < passed) {
      const double u = std::sqrt(random.Uniform());
      const double v = random.Uniform();
      const Eigen::Vector3d share(1 - u, u * (1 - v), u * v);
      const Eigen::Vector3d normal =
          face_normal + (share[0] * corner_normals.row(face[0]) +
                         share[1] * corner_normals.row(face[1]) +
                         share[2] * corner_normals.row(face[2]))
                            .transpose();
      ordered.positions.emplace_back(
          (share[0] * a + share[1] * b + share[2] * c).cast<float>());
      const bool cancels = normal.squaredNorm() < 1e-18;
      ordered.normals.emplace_back(
          (cancels ? face_normal : normal.normalized()).cast<float>());
      ordered.faces.push_back(f);
      next += step;
    }
  }
  for (size_t i = ordered.positions.size(); i > 1; --i) {
    const auto j = static_cast<size_t>(random.Below(i));
    std::swap(ordered.positions[i - 1], ordered.positions[j]);
    std::swap(ordered.normals[i - 1], ordered.normals[j]);
    std::swap(ordered.faces[i - 1], ordered.faces[j]);
  }
  return ordered;
}

OpenBoundary FindOpenBoundary(const TriangleMesh& mesh) {
  const std::vector<Edge> open = OpenEdges(mesh);
  OpenBoundary boundary;
  if (open.empty()) return boundary;
  std::vector<int32_t> parent(Slot(mesh.num_vertices()));
  std::iota(parent.begin(), parent.end(), 0);
  for (const Edge& edge : open) {
    parent[Slot(FindRoot(parent, edge[0]))] = FindRoot(parent, edge[1]);
  }
  std::vector<Eigen::AlignedBox3d> boxes(parent.size());
  for (const Edge& edge : open) {
    Eigen::AlignedBox3d& box = boxes[Slot(FindRoot(parent, edge[0]))];
    box.extend(mesh.vertex(edge[0]));
    box.extend(mesh.vertex(edge[1]));
  }
  for (const Edge& edge : open) {
    const Eigen::Vector3d a = mesh.vertex(edge[0]);
    const Eigen::Vector3d d = mesh.vertex(edge[1]) - a;
    const auto extent = static_cast<float>(
        boxes[Slot(FindRoot(parent, edge[0]))].diagonal().norm());
    const int steps =
        1 + static_cast<int>(std::min(1e4, d.norm() / kBoundaryStep));
    for (int i = 0; i < steps; ++i) {
      boundary.points.emplace_back((a + d * ((i + 0.5) / steps)).cast<float>());
      boundary.extent.push_back(extent);
    }
  }
  return boundary;
}

PointTree BoundaryForRadius(const OpenBoundary& boundary, float radius) {
  std::vector<Eigen::Vector3f> points;
  for (size_t i = 0; i < boundary.points.size(); ++i) {
    if (boundary.extent[i] >= kPinhole * radius) {
      points.push_back(boundary.points[i]);
    }
  }
  return PointTree(points);
}

}  // namespace argmesh
