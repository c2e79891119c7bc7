#include "tests/benchmark/cut_pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/area.h"
#include "core/synthesis/mesh_cut.h"
#include "tests/benchmark/hand_made_parts.h"

namespace argmesh {
namespace {

constexpr int kDiscs = 60;
constexpr int kMinDiscFaces = 30;

TriangleMesh KeepFaces(const TriangleMesh& mesh,
                       const std::vector<Eigen::Index>& faces) {
  TriangleMesh kept;
  kept.V = mesh.V;
  kept.F = mesh.F(faces, Eigen::all);
  RemoveUnusedVertices(kept);
  return kept;
}

Eigen::Vector3d Centroid(const TriangleMesh& mesh, int f) {
  return (mesh.vertex(mesh.F(f, 0)) + mesh.vertex(mesh.F(f, 1)) +
          mesh.vertex(mesh.F(f, 2))) /
         3;
}

}  // namespace

TriangleMesh LargestPiece(const TriangleMesh& mesh) {
  const std::vector<int32_t> pieces = ConnectedParts(
      mesh, std::vector<int32_t>(static_cast<size_t>(mesh.num_faces()), 0));
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  std::vector<double> piece_area(pieces.size(), 0);
  for (size_t f = 0; f < pieces.size(); ++f) {
    piece_area[static_cast<size_t>(pieces[f])] +=
        areas[static_cast<Eigen::Index>(f)];
  }
  const auto largest = static_cast<int32_t>(
      std::max_element(piece_area.begin(), piece_area.end()) -
      piece_area.begin());
  std::vector<Eigen::Index> kept;
  for (size_t f = 0; f < pieces.size(); ++f) {
    if (pieces[f] == largest) kept.push_back(static_cast<Eigen::Index>(f));
  }
  return KeepFaces(mesh, kept);
}

TriangleMesh CutByShare(const TriangleMesh& mesh,
                        const Eigen::Vector3d& direction, double share) {
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  std::vector<std::pair<double, double>> heights;  // and areas
  for (int f = 0; f < mesh.num_faces(); ++f) {
    heights.emplace_back(direction.dot(Centroid(mesh, f)), areas[f]);
  }
  std::sort(heights.begin(), heights.end());
  double area = 0;
  CutPlane plane;
  plane.normal = -direction;
  for (const auto& [height, face_area] : heights) {
    area += face_area;
    plane.offset = -height;
    if (area >= share * areas.sum()) break;
  }
  return LargestPiece(CutByPlane(mesh, plane));
}

Eigen::Vector3d RandomDirection(uint64_t seed) {
  Random random(seed);
  const double x = random.Normal();
  const double y = random.Normal();
  return Eigen::Vector3d(x, y, random.Normal()).normalized();
}

TriangleMesh FlattestDisc(const TriangleMesh& mesh, double radius,
                          uint64_t seed) {
  Random random(seed);
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  const double reach = radius * std::sqrt(areas.sum());
  VertexMatrix centroids(mesh.num_faces(), 3);
  VertexMatrix normals(mesh.num_faces(), 3);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d a = mesh.vertex(mesh.F(f, 0));
    centroids.row(f) = Centroid(mesh, f);
    normals.row(f) = (mesh.vertex(mesh.F(f, 1)) - a)
                         .cross(mesh.vertex(mesh.F(f, 2)) - a)
                         .normalized();
  }
  double best_bend = 1e9;
  std::vector<Eigen::Index> best;
  for (int i = 0; i < kDiscs; ++i) {
    const auto center = static_cast<Eigen::Index>(
        random.Below(static_cast<uint64_t>(mesh.num_faces())));
    std::vector<Eigen::Index> faces;
    double area = 0;
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    for (Eigen::Index f = 0; f < mesh.F.rows(); ++f) {
      if ((centroids.row(f) - centroids.row(center)).norm() >= reach ||
          normals.row(f).dot(normals.row(center)) <= 0.2) {
        continue;
      }
      faces.push_back(f);
      area += areas[f];
      mean += areas[f] * normals.row(f);
    }
    double bend = 1 - mean.norm() / area;
    if (area < 0.6 * std::numbers::pi * reach * reach) bend += 1;
    if (static_cast<int>(faces.size()) < kMinDiscFaces || bend >= best_bend) {
      continue;
    }
    best_bend = bend;
    best = std::move(faces);
  }
  return LargestPiece(KeepFaces(mesh, best));
}

}  // namespace argmesh
