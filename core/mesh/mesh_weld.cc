#include "core/mesh/mesh_weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "absl/container/flat_hash_map.h"
#include "core/mesh/mesh_edges.h"

namespace argmesh {
namespace {

constexpr double kSmallestFace = 1e-14;  // of the area
constexpr double kCellSize = 4;          // weld distances

// Finds kept vertices by position. Cells are larger than twice the distance,
// so a vertex looks into at most two per axis and mostly into one.
class KeptVertices {
 public:
  KeptVertices(const VertexMatrix& V, double distance)
      : V_(V),
        distance_(distance),
        next_(Slot(static_cast<int>(V.rows())), -1) {
    cells_.reserve(static_cast<size_t>(V.rows()));
  }

  // The lowest kept vertex within the distance of v, or -1.
  int32_t Find(int32_t v) const {
    int32_t found = -1;
    const Eigen::RowVector3d x = V_.row(v);
    const Cell low = CellOf(x.array() - distance_);
    const Cell high = CellOf(x.array() + distance_);
    // Two cells along each axis at most: bit a of `corner` is the side on
    // axis a.
    for (unsigned corner = 0; corner < 8; ++corner) {
      Cell cell = low;
      bool is_new = true;
      for (size_t axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1U) == 0) continue;
        is_new = is_new && low[axis] != high[axis];
        cell[axis] = high[axis];
      }
      if (is_new) found = FindInCell(x, cell, found);
    }
    return found;
  }

  void Keep(int32_t v) {
    int32_t& head =
        cells_.try_emplace(CellOf(V_.row(v).array()), -1).first->second;
    next_[Slot(v)] = head;
    head = v;
  }

 private:
  using Cell = std::array<double, 3>;

  // Adding zero makes -0 and 0 one cell.
  Cell CellOf(const Eigen::Array<double, 1, 3>& x) const {
    if (distance_ == 0) return {x[0] + 0.0, x[1] + 0.0, x[2] + 0.0};
    const double size = kCellSize * distance_;
    return {std::floor(x[0] / size) + 0.0, std::floor(x[1] / size) + 0.0,
            std::floor(x[2] / size) + 0.0};
  }

  int32_t FindInCell(const Eigen::RowVector3d& x, const Cell& cell,
                     int32_t found) const {
    const auto it = cells_.find(cell);
    if (it == cells_.end()) return found;
    for (int32_t w = it->second; w >= 0; w = next_[Slot(w)]) {
      if ((found < 0 || w < found) &&
          (V_.row(w) - x).squaredNorm() <= distance_ * distance_) {
        found = w;
      }
    }
    return found;
  }

  const VertexMatrix& V_;
  double distance_;
  absl::flat_hash_map<Cell, int32_t> cells_;
  std::vector<int32_t> next_;  // in the same cell
};

std::vector<char> MarkUsedVertices(const TriangleMesh& mesh) {
  std::vector<char> used(Slot(mesh.num_vertices()), 0);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) used[Slot(mesh.F(f, c))] = 1;
  }
  return used;
}

// For each used vertex its row in welded.mesh.V, which is filled; -1 for the
// others.
std::vector<int32_t> WeldVertices(const TriangleMesh& mesh, double distance,
                                  WeldedMesh& welded) {
  const std::vector<char> used = MarkUsedVertices(mesh);
  std::vector<int32_t> row(used.size(), -1);
  KeptVertices kept(mesh.V, distance);
  welded.mesh.V.resize(mesh.num_vertices(), 3);
  int32_t rows = 0;
  for (int32_t v = 0; v < mesh.num_vertices(); ++v) {
    if (!used[Slot(v)]) {
      ++welded.unused_vertices;
      continue;
    }
    const int32_t same = kept.Find(v);
    if (same >= 0) {
      row[Slot(v)] = row[Slot(same)];
      ++welded.welded_vertices;
      continue;
    }
    kept.Keep(v);
    welded.mesh.V.row(rows) = mesh.V.row(v);
    row[Slot(v)] = rows++;
  }
  welded.mesh.V.conservativeResize(rows, 3);
  return row;
}

void DropDegenerateFaces(const TriangleMesh& mesh,
                         const std::vector<int32_t>& row, WeldedMesh& welded) {
  FaceMatrix& F = welded.mesh.F;
  F.resize(mesh.num_faces(), 3);
  const double smallest = kSmallestFace * welded.area;
  int kept = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) F(kept, c) = row[Slot(mesh.F(f, c))];
    const bool distinct = F(kept, 0) != F(kept, 1) &&
                          F(kept, 1) != F(kept, 2) && F(kept, 2) != F(kept, 0);
    // Also false where the area is not a number.
    if (distinct && FaceCross(welded.mesh, kept).norm() / 2 > smallest) {
      welded.source_face.push_back(f);
      ++kept;
    } else {
      ++welded.degenerate_faces;
    }
  }
  F.conservativeResize(kept, 3);
}

void DropDuplicateFaces(WeldedMesh& welded) {
  FaceMatrix& F = welded.mesh.F;
  const int num_faces = welded.mesh.num_faces();
  std::vector<std::array<int32_t, 4>> keys(Slot(num_faces));
  for (int f = 0; f < num_faces; ++f) {
    keys[Slot(f)] = {F(f, 0), F(f, 1), F(f, 2), f};
    std::sort(keys[Slot(f)].begin(), keys[Slot(f)].begin() + 3);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<char> duplicate(keys.size(), 0);
  for (size_t i = 1; i < keys.size(); ++i) {
    if (std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin())) {
      duplicate[Slot(keys[i][3])] = 1;
      ++welded.duplicate_faces;
    }
  }
  if (welded.duplicate_faces == 0) return;
  int kept = 0;
  for (int f = 0; f < num_faces; ++f) {
    if (duplicate[Slot(f)]) continue;
    F.row(kept) = F.row(f);
    welded.source_face[Slot(kept)] = welded.source_face[Slot(f)];
    ++kept;
  }
  F.conservativeResize(kept, 3);
  welded.source_face.resize(Slot(kept));
}

}  // namespace

WeldedMesh WeldMesh(const TriangleMesh& mesh, double weld_distance) {
  WeldedMesh welded;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    welded.area += FaceCross(mesh, f).norm() / 2;
  }
  const double distance = weld_distance * std::sqrt(welded.area);
  const std::vector<int32_t> row =
      WeldVertices(mesh, std::isfinite(distance) ? distance : 0, welded);
  DropDegenerateFaces(mesh, row, welded);
  DropDuplicateFaces(welded);
  RemoveUnusedVertices(welded.mesh);
  return welded;
}

}  // namespace argmesh
