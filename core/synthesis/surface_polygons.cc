#include "core/synthesis/surface_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/synthesis/dual_polygons.h"
#include "core/synthesis/surface_grid.h"

namespace argmesh {
namespace {

using Eigen::Vector3d;

constexpr int kCoarseCells = 44;   // along the longest side, to find the area
constexpr int kFinestCells = 420;  // along the longest side
constexpr double kVerticesPerCellArea = 1.45;

double ChooseCell(const ImplicitSurface& surface, int target_vertices) {
  const double longest = surface.Bounds().sizes().maxCoeff();
  const double area =
      SurfaceGrid(surface, longest / kCoarseCells).EstimateArea();
  const double cell = std::sqrt(kVerticesPerCellArea * area / target_vertices);
  return std::max(cell, longest / kFinestCells);
}

struct SurfacePoint {
  double distance = 0;
  Vector3d gradient = Vector3d::Zero();
};

// Distance and gradient from four probes at the corners of a tetrahedron.
SurfacePoint Probe(const ImplicitSurface& surface, const Vector3d& p,
                   double step, std::span<const int32_t> terms) {
  const std::array<Vector3d, 4> directions = {
      Vector3d(1, -1, -1), Vector3d(-1, -1, 1), Vector3d(-1, 1, -1),
      Vector3d(1, 1, 1)};
  SurfacePoint point;
  for (const Vector3d& direction : directions) {
    const double distance = surface.Distance(p + step * direction, terms);
    point.gradient += distance * direction / (4 * step);
    point.distance += 0.25 * distance;
  }
  return point;
}

// Each vertex moves halfway to the middle of its neighbours, keeps only the
// part of that along the surface, and returns onto the surface.
void Relax(const ImplicitSurface& surface, const SurfaceGrid& grid,
           DualPolygons& polygons) {
  const size_t n = polygons.positions.size();
  std::vector<Vector3d> sums(n, Vector3d::Zero());
  std::vector<int> counts(n, 0);
  for (size_t i = 0; i + 1 < polygons.offsets.size(); ++i) {
    const auto begin = static_cast<size_t>(polygons.offsets[i]);
    const auto end = static_cast<size_t>(polygons.offsets[i + 1]);
    for (size_t j = begin, before = end - 1; j < end; before = j++) {
      // Every edge is met once from each side: one direction is enough.
      const auto from = static_cast<size_t>(polygons.corners[before]);
      const auto to = static_cast<size_t>(polygons.corners[j]);
      sums[from] += polygons.positions[to];
      ++counts[from];
    }
  }
  const double step = 0.1 * grid.cell();
  const double limit = 0.5 * grid.cell();
  for (size_t v = 0; v < n; ++v) {
    Vector3d& p = polygons.positions[v];
    const auto terms = grid.Terms(polygons.cells[v]);
    const SurfacePoint at = Probe(surface, p, step, terms);
    const double slope2 = std::max(at.gradient.squaredNorm(), 0.05);
    Vector3d move = 0.5 * (sums[v] / counts[v] - p);
    move -= at.gradient * (move.dot(at.gradient) / slope2);
    move -= at.gradient * (at.distance / slope2);
    const double length = move.norm();
    if (length > limit) move *= limit / length;
    p += move;
  }
}

class Triangulator {
 public:
  explicit Triangulator(DualPolygons polygons)
      : polygons_(std::move(polygons)) {}

  TriangleMesh Triangulate() && {
    for (size_t i = 0; i + 1 < polygons_.offsets.size(); ++i) {
      const std::span<const int32_t> corners(
          polygons_.corners.data() + polygons_.offsets[i],
          static_cast<size_t>(polygons_.offsets[i + 1] - polygons_.offsets[i]));
      corners.size() == 4 ? SplitQuad(corners) : SplitAroundMiddle(corners);
    }
    TriangleMesh mesh;
    mesh.V.resize(static_cast<Eigen::Index>(polygons_.positions.size()), 3);
    for (Eigen::Index v = 0; v < mesh.V.rows(); ++v) {
      mesh.V.row(v) = polygons_.positions[static_cast<size_t>(v)].transpose();
    }
    mesh.F.resize(static_cast<Eigen::Index>(faces_.size()), 3);
    for (Eigen::Index f = 0; f < mesh.F.rows(); ++f) {
      const auto& face = faces_[static_cast<size_t>(f)];
      mesh.F.row(f) << face[0], face[1], face[2];
    }
    return mesh;
  }

 private:
  const Vector3d& Position(int32_t v) const {
    return polygons_.positions[static_cast<size_t>(v)];
  }
  double SquaredLength(int32_t v, int32_t w) const {
    return (Position(v) - Position(w)).squaredNorm();
  }

  void SplitQuad(std::span<const int32_t> q) {
    if (SquaredLength(q[0], q[2]) <= SquaredLength(q[1], q[3])) {
      faces_.push_back({q[0], q[1], q[2]});
      faces_.push_back({q[0], q[2], q[3]});
    } else {
      faces_.push_back({q[1], q[2], q[3]});
      faces_.push_back({q[1], q[3], q[0]});
    }
  }

  void SplitAroundMiddle(std::span<const int32_t> polygon) {
    Vector3d middle = Vector3d::Zero();
    for (const int32_t v : polygon) middle += Position(v);
    const auto center = static_cast<int32_t>(polygons_.positions.size());
    polygons_.positions.push_back(middle / static_cast<double>(polygon.size()));
    for (size_t i = 0, before = polygon.size() - 1; i < polygon.size();
         before = i++) {
      faces_.push_back({polygon[before], polygon[i], center});
    }
  }

  DualPolygons polygons_;
  std::vector<std::array<int32_t, 3>> faces_;
};

std::vector<int32_t> LabelFaces(const ImplicitSurface& surface,
                                const SurfaceGrid& grid,
                                const std::vector<GridCorner>& cells,
                                const TriangleMesh& mesh) {
  std::vector<int32_t> parts(static_cast<size_t>(mesh.num_faces()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Vector3d centroid =
        (mesh.vertex(mesh.F(f, 0)) + mesh.vertex(mesh.F(f, 1)) +
         mesh.vertex(mesh.F(f, 2))) /
        3;
    // The middle of a split polygon is always the last corner of its faces.
    const auto cell = cells[static_cast<size_t>(mesh.F(f, 0))];
    parts[static_cast<size_t>(f)] = surface.PartAt(centroid, grid.Terms(cell));
  }
  return parts;
}

}  // namespace

absl::StatusOr<PolygonizedSurface> PolygonizeSurface(
    const ImplicitSurface& surface, const PolygonizeOptions& options) {
  if (options.target_vertices < 100 || options.target_vertices > 200'000) {
    return absl::InvalidArgumentError(
        absl::StrFormat("target_vertices %d is outside 100 .. 200000",
                        options.target_vertices));
  }
  if (options.relax_rounds < 0 || options.relax_rounds > 20) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "relax_rounds %d is outside 0 .. 20", options.relax_rounds));
  }
  if (surface.num_primitives() == 0) {
    return absl::FailedPreconditionError("the surface has no primitives");
  }
  const SurfaceGrid grid(surface, ChooseCell(surface, options.target_vertices));
  DualPolygons polygons = BuildDualPolygons(grid);
  if (polygons.num_polygons() == 0) {
    return absl::FailedPreconditionError("the surface is empty");
  }
  for (int round = 0; round < options.relax_rounds; ++round) {
    Relax(surface, grid, polygons);
  }
  const std::vector<GridCorner> cells = polygons.cells;
  PolygonizedSurface result;
  result.mesh = Triangulator(std::move(polygons)).Triangulate();
  result.part_of_face = LabelFaces(surface, grid, cells, result.mesh);
  return result;
}

}  // namespace argmesh
