#include "core/geometry/surface_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>

#include "core/geometry/surface_bridges.h"

namespace argmesh {
namespace {

// One side of an edge: from < to.
struct EdgeSide {
  int32_t from;
  int32_t to;
  int32_t opposite;  // third corner of the face
};

struct Link {
  int32_t from;
  int32_t to;
  LinkKind kind;
  double length;
};

std::vector<EdgeSide> CollectEdgeSides(const TriangleMesh& mesh) {
  std::vector<EdgeSide> sides;
  sides.reserve(static_cast<size_t>(mesh.num_faces()) * 3);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int32_t a = mesh.F(f, k);
      const int32_t b = mesh.F(f, (k + 1) % 3);
      if (a == b) continue;
      sides.push_back({std::min(a, b), std::max(a, b), mesh.F(f, (k + 2) % 3)});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const EdgeSide& a, const EdgeSide& b) {
              return std::tie(a.from, a.to, a.opposite) <
                     std::tie(b.from, b.to, b.opposite);
            });
  return sides;
}

// Length of the straight line between the two corners opposite to an edge once
// its faces are unfolded into one plane; none when it leaves the two faces.
std::optional<double> UnfoldedDiagonal(const TriangleMesh& mesh,
                                       const EdgeSide& s, const EdgeSide& t) {
  if (s.opposite == t.opposite) return std::nullopt;
  const Eigen::Vector3d origin = mesh.vertex(s.from);
  const Eigen::Vector3d edge = mesh.vertex(s.to) - origin;
  const double length = edge.norm();
  if (!(length > 0)) return std::nullopt;
  const Eigen::Vector3d axis = edge / length;
  const Eigen::Vector3d p = mesh.vertex(s.opposite) - origin;
  const Eigen::Vector3d q = mesh.vertex(t.opposite) - origin;
  const double px = p.dot(axis);
  const double qx = q.dot(axis);
  const double py = axis.cross(p).norm();
  const double qy = axis.cross(q).norm();
  if (!(py > 0) || !(qy > 0)) return std::nullopt;
  const double crossing = (px * qy + qx * py) / (py + qy);
  if (!(crossing > 0) || !(crossing < length)) return std::nullopt;
  return std::hypot(px - qx, py + qy);
}

struct MeshLinks {
  std::vector<Link> links;
  double mean_edge_length = 0;
};

MeshLinks CollectMeshLinks(const TriangleMesh& mesh, bool diagonals) {
  const std::vector<EdgeSide> sides = CollectEdgeSides(mesh);
  MeshLinks out;
  out.links.reserve(sides.size());
  double total_length = 0;
  int num_edges = 0;
  for (size_t i = 0, j = 0; i < sides.size(); i = j) {
    const EdgeSide& side = sides[i];
    while (j < sides.size() && sides[j].from == side.from &&
           sides[j].to == side.to) {
      ++j;
    }
    const double length =
        (mesh.vertex(side.to) - mesh.vertex(side.from)).norm();
    total_length += length;
    ++num_edges;
    out.links.push_back({side.from, side.to, LinkKind::kEdge, length});
    if (!diagonals || j - i != 2) continue;
    if (const auto diagonal = UnfoldedDiagonal(mesh, side, sides[i + 1])) {
      out.links.push_back({side.opposite, sides[i + 1].opposite,
                           LinkKind::kDiagonal, *diagonal});
    }
  }
  if (num_edges > 0) out.mean_edge_length = total_length / num_edges;
  return out;
}

struct Target {
  int32_t vertex;
  LinkKind kind;
  float length;
};

// An edge comes before a diagonal of the same pair: it is never longer, but
// rounding may make it seem so.
bool Before(const Target& a, const Target& b) {
  return std::tie(a.vertex, a.kind, a.length) <
         std::tie(b.vertex, b.kind, b.length);
}

void WriteRows(const std::vector<Link>& links, int num_vertices,
               SurfaceGraph& graph) {
  std::vector<size_t> begin(static_cast<size_t>(num_vertices) + 1, 0);
  for (const Link& link : links) {
    ++begin[static_cast<size_t>(link.from) + 1];
    ++begin[static_cast<size_t>(link.to) + 1];
  }
  for (size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<Target> rows(links.size() * 2);
  std::vector<size_t> next = begin;
  for (const Link& link : links) {
    const float length = std::max(static_cast<float>(link.length),
                                  std::numeric_limits<float>::min());
    rows[next[static_cast<size_t>(link.from)]++] = {link.to, link.kind, length};
    rows[next[static_cast<size_t>(link.to)]++] = {link.from, link.kind, length};
  }
  graph.offsets.assign(1, 0);
  graph.targets.clear();
  graph.lengths.clear();
  graph.kinds.clear();
  for (size_t v = 0; v + 1 < begin.size(); ++v) {
    Target* const first = rows.data() + begin[v];
    Target* const last = rows.data() + begin[v + 1];
    std::sort(first, last, Before);
    for (const Target* t = first; t != last; ++t) {
      if (t != first && t->vertex == (t - 1)->vertex) continue;
      graph.targets.push_back(t->vertex);
      graph.lengths.push_back(t->length);
      graph.kinds.push_back(t->kind);
    }
    graph.offsets.push_back(static_cast<int32_t>(graph.targets.size()));
  }
}

// Edges never leave a component, diagonals neither: both are followed.
void FindComponents(SurfaceGraph& graph) {
  const int n = graph.num_vertices();
  graph.component_of_vertex.assign(static_cast<size_t>(n), -1);
  graph.num_components = 0;
  int32_t* component = graph.component_of_vertex.data();
  const int32_t* offsets = graph.offsets.data();
  const int32_t* targets = graph.targets.data();
  std::vector<int32_t> stack;
  for (int32_t v = 0; v < n; ++v) {
    if (component[v] >= 0) continue;
    component[v] = graph.num_components;
    stack.push_back(v);
    while (!stack.empty()) {
      const int32_t u = stack.back();
      stack.pop_back();
      for (int32_t e = offsets[u]; e < offsets[u + 1]; ++e) {
        if (component[targets[e]] >= 0) continue;
        component[targets[e]] = graph.num_components;
        stack.push_back(targets[e]);
      }
    }
    ++graph.num_components;
  }
}

}  // namespace

SurfaceGraph BuildSurfaceGraph(const TriangleMesh& mesh,
                               const SurfaceGraphOptions& options) {
  MeshLinks mesh_links = CollectMeshLinks(mesh, options.diagonals);
  SurfaceGraph graph;
  WriteRows(mesh_links.links, mesh.num_vertices(), graph);
  FindComponents(graph);
  if (!options.bridges || graph.num_components < 2) return graph;
  for (const Bridge& bridge :
       ComputeBridges(mesh.V, graph.component_of_vertex, graph.num_components,
                      options.bridge_radius * mesh_links.mean_edge_length)) {
    mesh_links.links.push_back(
        {bridge.from, bridge.to, LinkKind::kBridge, bridge.length});
  }
  WriteRows(mesh_links.links, mesh.num_vertices(), graph);
  return graph;
}

}  // namespace argmesh
