#include "core/mesh/mesh_subdivide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/status_macros.h"
#include "core/mesh/mesh_edges.h"

namespace argmesh {
namespace {

constexpr double kAboutEqual = 1e-3;
constexpr double kTighten = 0.8;  // of the bound, where samples are too few
// Halves 2^60 lengths, more than doubles of one mesh can differ in practice.
constexpr int kMaxPasses = 120;

double SquaredLength(const TriangleMesh& mesh, int32_t a, int32_t b) {
  return (mesh.V.row(a) - mesh.V.row(b)).squaredNorm();
}

bool HasLongEdge(const TriangleMesh& mesh, double bound) {
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      if (SquaredLength(mesh, mesh.F(f, c), mesh.F(f, (c + 1) % 3)) >
          bound * bound) {
        return true;
      }
    }
  }
  return false;
}

// Edges longer than `bound`; the longest `room` of them when there are more.
std::vector<size_t> FindLongEdges(const TriangleMesh& mesh,
                                  const MeshEdges& edges, double bound,
                                  size_t room) {
  struct LongEdge {
    double squared_length;
    size_t edge;
  };
  std::vector<LongEdge> found;
  for (size_t e = 0; e < edges.size(); ++e) {
    const auto& [a, b] = edges.ends[e];
    const double squared_length = SquaredLength(mesh, a, b);
    if (squared_length > bound * bound) found.push_back({squared_length, e});
  }
  if (found.size() > room) {
    std::sort(found.begin(), found.end(),
              [](const LongEdge& x, const LongEdge& y) {
                return x.squared_length != y.squared_length
                           ? x.squared_length > y.squared_length
                           : x.edge < y.edge;
              });
    found.resize(room);
  }
  std::vector<size_t> split;
  split.reserve(found.size());
  for (const LongEdge& entry : found) split.push_back(entry.edge);
  std::sort(split.begin(), split.end());
  return split;
}

using Triangle = std::array<int32_t, 3>;

// Cuts one face; middle[c] is the midpoint of side c or -1.
void CutFace(const TriangleMesh& mesh, const Triangle& face,
             const Triangle& middle, std::vector<Triangle>& out) {
  int split_sides = 0;
  for (const int32_t m : middle) split_sides += m >= 0 ? 1 : 0;
  if (split_sides == 0) {
    out.push_back(face);
    return;
  }
  if (split_sides == 3) {
    out.push_back({face[0], middle[0], middle[2]});
    out.push_back({middle[0], face[1], middle[1]});
    out.push_back({middle[2], middle[1], face[2]});
    out.push_back({middle[0], middle[1], middle[2]});
    return;
  }
  // Turned so that the side unlike the other two is a to b.
  size_t odd = 0;
  while ((middle[odd] >= 0) != (split_sides == 1)) ++odd;
  const int32_t a = face[odd];
  const int32_t b = face[(odd + 1) % 3];
  const int32_t c = face[(odd + 2) % 3];
  if (split_sides == 1) {
    out.push_back({a, middle[odd], c});
    out.push_back({middle[odd], b, c});
    return;
  }
  const int32_t bc = middle[(odd + 1) % 3];
  const int32_t ca = middle[(odd + 2) % 3];
  out.push_back({ca, bc, c});
  // The shorter diagonal; of about equal ones that from the lower number,
  // which rounding does not decide.
  const double from_a = SquaredLength(mesh, a, bc);
  const double from_b = SquaredLength(mesh, b, ca);
  const bool about_equal =
      std::abs(from_a - from_b) < kAboutEqual * (from_a + from_b);
  if (about_equal ? a < b : from_a < from_b) {
    out.push_back({a, b, bc});
    out.push_back({a, bc, ca});
  } else {
    out.push_back({a, b, ca});
    out.push_back({b, bc, ca});
  }
}

void SplitEdges(const MeshEdges& edges, const std::vector<size_t>& split,
                TriangleMesh& mesh) {
  std::vector<int32_t> middle(3 * Slot(mesh.num_faces()), -1);
  Eigen::Index next = mesh.V.rows();
  mesh.V.conservativeResize(next + static_cast<Eigen::Index>(split.size()), 3);
  for (const size_t e : split) {
    const auto& [a, b] = edges.ends[e];
    mesh.V.row(next) = (mesh.V.row(a) + mesh.V.row(b)) / 2;
    for (const int32_t side : edges.sides_of(e)) {
      middle[Slot(side)] = static_cast<int32_t>(next);
    }
    ++next;
  }
  std::vector<Triangle> faces;
  faces.reserve(Slot(mesh.num_faces()) + 2 * split.size());
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const size_t side = 3 * Slot(f);
    CutFace(mesh, {mesh.F(f, 0), mesh.F(f, 1), mesh.F(f, 2)},
            {middle[side], middle[side + 1], middle[side + 2]}, faces);
  }
  mesh.F.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (size_t f = 0; f < faces.size(); ++f) {
    for (size_t c = 0; c < 3; ++c) {
      mesh.F(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(c)) =
          faces[f][c];
    }
  }
}

}  // namespace

absl::Status SubdivideLongEdges(const SubdivideOptions& options,
                                const StopToken& stop, TriangleMesh& mesh) {
  double bound = options.max_edge_length;
  size_t room = Slot(std::max(options.max_new_vertices, 0));
  for (int pass = 0; pass < kMaxPasses && room > 0; ++pass) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    if (!HasLongEdge(mesh, bound)) {
      if (mesh.num_vertices() >= options.min_vertices) break;
      bound *= kTighten;
      continue;
    }
    const MeshEdges edges = ComputeMeshEdges(mesh.F, mesh.num_vertices());
    const std::vector<size_t> split = FindLongEdges(mesh, edges, bound, room);
    SplitEdges(edges, split, mesh);
    room -= split.size();
  }
  return absl::OkStatus();
}

}  // namespace argmesh
