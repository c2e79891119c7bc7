#include "core/containment/open_orientation.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/geometry/area.h"
#include "core/mesh/mesh_edges.h"

namespace argmesh {
namespace {

constexpr double kMinShareOfBall = 0.1;

// The piece of each face, and how many there are.
std::pair<std::vector<int32_t>, int32_t> FindPieces(
    const std::vector<int32_t>& twins, int num_faces) {
  std::vector<int32_t> piece(Slot(num_faces), -1);
  std::vector<int32_t> stack;
  int32_t count = 0;
  for (int32_t seed = 0; seed < num_faces; ++seed) {
    if (piece[Slot(seed)] >= 0) continue;
    piece[Slot(seed)] = count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int32_t face = stack.back();
      stack.pop_back();
      for (int32_t side = 3 * face; side < 3 * face + 3; ++side) {
        const int32_t twin = twins[Slot(side)];
        if (twin < 0 || piece[Slot(twin / 3)] >= 0) continue;
        piece[Slot(twin / 3)] = count;
        stack.push_back(twin / 3);
      }
    }
    ++count;
  }
  return {std::move(piece), count};
}

struct Piece {
  double area = 0;
  double volume = 0;
  double border_length = 0;
  Eigen::Vector3d border_sum = Eigen::Vector3d::Zero();
};

}  // namespace

void OrientOpenPieces(TriangleMesh& mesh) {
  const std::vector<int32_t> twins = ComputeTwins(
      ComputeMeshEdges(mesh.F, mesh.num_vertices()), mesh.num_faces());
  const auto [piece_of_face, count] = FindPieces(twins, mesh.num_faces());
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  std::vector<Piece> pieces(Slot(count));
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    Piece& piece = pieces[Slot(piece_of_face[Slot(f)])];
    piece.area += areas[f];
    for (int k = 0; k < 3; ++k) {
      if (twins[Slot(3 * f + k)] >= 0) continue;
      const Eigen::Vector3d a = mesh.vertex(mesh.F(f, k));
      const Eigen::Vector3d b = mesh.vertex(mesh.F(f, (k + 1) % 3));
      const double length = (b - a).norm();
      piece.border_length += length;
      piece.border_sum += length / 2 * (a + b);
    }
  }
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    Piece& piece = pieces[Slot(piece_of_face[Slot(f)])];
    if (piece.border_length <= 0) continue;
    const Eigen::Vector3d apex = piece.border_sum / piece.border_length;
    piece.volume += (mesh.vertex(mesh.F(f, 0)) - apex)
                        .dot((mesh.vertex(mesh.F(f, 1)) - apex)
                                 .cross(mesh.vertex(mesh.F(f, 2)) - apex)) /
                    6;
  }
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    const Piece& piece = pieces[Slot(piece_of_face[Slot(f)])];
    const double ball =
        std::pow(piece.area, 1.5) / (6 * std::sqrt(std::numbers::pi));
    if (piece.volume < -kMinShareOfBall * ball) {
      std::swap(mesh.F(f, 1), mesh.F(f, 2));
    }
  }
}

}  // namespace argmesh
