#include "core/containment/open_orientation.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/geometry/area.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_orient.h"

namespace argmesh {
namespace {

constexpr double kMinShareOfBall = 0.1;

struct Piece {
  double area = 0;
  double volume = 0;
  double border_length = 0;
  Eigen::Vector3d border_sum = Eigen::Vector3d::Zero();
};

}  // namespace

void OrientOpenPieces(TriangleMesh& mesh) {
  // Already consistent after a repair; what is asked for are the pieces.
  const OrientedFaces oriented =
      OrientFaces(mesh, ComputeMeshEdges(mesh.F, mesh.num_vertices()));
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  std::vector<Piece> pieces(Slot(oriented.num_components));
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    Piece& piece = pieces[Slot(oriented.component[Slot(f)])];
    piece.area += areas[f];
    for (int k = 0; k < 3; ++k) {
      if (oriented.twins[Slot(3 * f + k)] >= 0) continue;
      const Eigen::Vector3d a = mesh.vertex(mesh.F(f, k));
      const Eigen::Vector3d b = mesh.vertex(mesh.F(f, (k + 1) % 3));
      const double length = (b - a).norm();
      piece.border_length += length;
      piece.border_sum += length / 2 * (a + b);
    }
  }
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    Piece& piece = pieces[Slot(oriented.component[Slot(f)])];
    if (piece.border_length <= 0) continue;
    const Eigen::Vector3d apex = piece.border_sum / piece.border_length;
    piece.volume += (mesh.vertex(mesh.F(f, 0)) - apex)
                        .dot((mesh.vertex(mesh.F(f, 1)) - apex)
                                 .cross(mesh.vertex(mesh.F(f, 2)) - apex)) /
                    6;
  }
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    const Piece& piece = pieces[Slot(oriented.component[Slot(f)])];
    const double ball =
        std::pow(piece.area, 1.5) / (6 * std::sqrt(std::numbers::pi));
    if (piece.volume < -kMinShareOfBall * ball) {
      std::swap(mesh.F(f, 1), mesh.F(f, 2));
    }
  }
}

}  // namespace argmesh
