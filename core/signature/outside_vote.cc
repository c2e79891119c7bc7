#include "core/signature/outside_vote.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/status_macros.h"
#include "core/geometry/area.h"
#include "core/geometry/ray_scene.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_weld.h"
#include "core/signature/ray_fields.h"

namespace argmesh {
namespace {

constexpr int kPoints = 4096;
constexpr int kVoteRays = 8;
constexpr double kSteepest = 0.95;  // cosine to the normal
constexpr double kFlattest = 0.25;
constexpr int kPointsBetweenStops = 256;

struct Pieces {
  std::vector<int32_t> of_face;
  std::vector<char> open;  // by piece
};

// The faces that wind alike across an edge of two; -1 elsewhere.
std::vector<int32_t> ConsistentTwins(const TriangleMesh& mesh,
                                     const MeshEdges& edges) {
  std::vector<int32_t> twins = ComputeTwins(edges, mesh.num_faces());
  const auto start = [&mesh](int32_t side) {
    return mesh.F(side / 3, side % 3);
  };
  for (int32_t side = 0; side < 3 * mesh.num_faces(); ++side) {
    const int32_t twin = twins[Slot(side)];
    if (twin < side || start(twin) != start(side)) continue;
    twins[Slot(side)] = twins[Slot(twin)] = -1;
  }
  return twins;
}

Pieces FindPieces(const TriangleMesh& mesh, const MeshEdges& edges) {
  const std::vector<int32_t> twins = ConsistentTwins(mesh, edges);
  Pieces pieces;
  pieces.of_face.assign(Slot(mesh.num_faces()), -1);
  std::vector<int32_t> stack;
  for (int32_t seed = 0; seed < mesh.num_faces(); ++seed) {
    if (pieces.of_face[Slot(seed)] >= 0) continue;
    const auto piece = static_cast<int32_t>(pieces.open.size());
    pieces.open.push_back(0);
    pieces.of_face[Slot(seed)] = piece;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int32_t face = stack.back();
      stack.pop_back();
      for (int32_t side = 3 * face; side < 3 * face + 3; ++side) {
        const int32_t twin = twins[Slot(side)];
        if (twin < 0) {
          pieces.open.back() = 1;
        } else if (pieces.of_face[Slot(twin / 3)] < 0) {
          pieces.of_face[Slot(twin / 3)] = piece;
          stack.push_back(twin / 3);
        }
      }
    }
  }
  return pieces;
}

// Directions over the half space of +z.
std::array<Eigen::Vector3f, kVoteRays> HalfSpaceDirections() {
  std::array<Eigen::Vector3f, kVoteRays> directions;
  for (size_t i = 0; i < directions.size(); ++i) {
    const double z = kSteepest - (kSteepest - kFlattest) *
                                     static_cast<double>(i) / (kVoteRays - 1);
    const double r = std::sqrt(1 - z * z);
    const double azimuth =
        static_cast<double>(i) * (3 - std::sqrt(5.0)) * std::numbers::pi;
    directions[i] =
        Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), z)
            .cast<float>();
  }
  return directions;
}

// By how many more rays escape from the front of a point than from its back.
int CountEscapes(const RayScene& scene, const Eigen::Vector3f& point,
                 const Eigen::Vector3f& normal) {
  static const std::array<Eigen::Vector3f, kVoteRays> directions =
      HalfSpaceDirections();
  Eigen::Matrix3f frame;
  frame.col(2) = normal;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  int lead = 0;
  for (const Eigen::Vector3f& direction : directions) {
    const Eigen::Vector3f ray = frame * direction;
    const Eigen::Vector3f back = ray - 2 * direction.z() * normal;
    if (!scene.IsOccluded(point + kRayOffset * normal, ray)) ++lead;
    if (!scene.IsOccluded(point - kRayOffset * normal, back)) --lead;
  }
  return lead;
}

}  // namespace

absl::Status TurnOpenPiecesOut(const StopToken& stop, TriangleMesh& mesh) {
  const Pieces pieces =
      FindPieces(mesh, ComputeMeshEdges(mesh.F, mesh.num_vertices()));
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  double open_area = 0;
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    if (pieces.open[Slot(pieces.of_face[Slot(f)])]) open_area += areas[f];
  }
  if (!(open_area > 0)) return absl::OkStatus();
  ARGMESH_ASSIGN_OR_RETURN(const RayScene scene, RayScene::Create(mesh));
  std::vector<int64_t> lead(pieces.open.size(), 0);
  // One point in the middle of a face for each step of area that ends in it.
  const double step = open_area / kPoints;
  double next = step / 2;
  double passed = 0;
  int points = 0;
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    const int32_t piece = pieces.of_face[Slot(f)];
    if (!pieces.open[Slot(piece)]) continue;
    passed += areas[f];
    if (passed < next) continue;
    const double steps = std::floor((passed - next) / step) + 1;
    next += steps * step;
    if (++points % kPointsBetweenStops == 0) {
      ARGMESH_RETURN_IF_ERROR(stop.Check());
    }
    const Eigen::Vector3d middle =
        (mesh.vertex(mesh.F(f, 0)) + mesh.vertex(mesh.F(f, 1)) +
         mesh.vertex(mesh.F(f, 2))) /
        3;
    lead[Slot(piece)] +=
        static_cast<int64_t>(steps) *
        CountEscapes(scene, middle.cast<float>(),
                     FaceCross(mesh, f).normalized().cast<float>());
  }
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    if (lead[Slot(pieces.of_face[Slot(f)])] < 0) {
      std::swap(mesh.F(f, 1), mesh.F(f, 2));
    }
  }
  return absl::OkStatus();
}

}  // namespace argmesh
