#include "core/signature/implicit_smoothing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/status_macros.h"
#include "core/geometry/area.h"

namespace argmesh {
namespace {

constexpr double kMinCotangent = 0.05;
constexpr double kMaxCotangent = 5;
constexpr double kMinVertexShare = 1e-9;  // of the mean area of a vertex
constexpr double kTolerance = 1e-4;
constexpr int kMaxRounds = 200;

// M + t A L, applied edge by edge.
struct System {
  const MeshEdges& edges;
  std::vector<double> weights;  // by edge
  Eigen::VectorXd masses;       // by vertex
  Eigen::VectorXd diagonal;

  void Apply(const VertexMatrix& x, VertexMatrix& y) const {
    y = masses.asDiagonal() * x;
    for (size_t e = 0; e < edges.size(); ++e) {
      const auto [a, b] = edges.ends[e];
      const Eigen::RowVector3d pull = weights[e] * (x.row(a) - x.row(b));
      y.row(a) += pull;
      y.row(b) -= pull;
    }
  }
};

// Of the corner of the face that does not lie on `side`.
double OppositeCotangent(const TriangleMesh& mesh, int32_t side) {
  const int32_t face = side / 3;
  const int32_t corner = side % 3;
  const Eigen::Vector3d apex = mesh.vertex(mesh.F(face, (corner + 2) % 3));
  const Eigen::Vector3d u = mesh.vertex(mesh.F(face, corner)) - apex;
  const Eigen::Vector3d w = mesh.vertex(mesh.F(face, (corner + 1) % 3)) - apex;
  const double cross = u.cross(w).norm();
  const double cotangent = cross > 0 ? u.dot(w) / cross : 0;
  return std::clamp(cotangent, kMinCotangent, kMaxCotangent);
}

System BuildSystem(const TriangleMesh& mesh, const MeshEdges& edges,
                   double time) {
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  const double area = areas.sum();
  System system{edges, {}, {}, {}};
  system.masses = Eigen::VectorXd::Constant(
      mesh.num_vertices(), kMinVertexShare * area / mesh.num_vertices());
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) system.masses[mesh.F(f, c)] += areas[f] / 3;
  }
  system.diagonal = system.masses;
  system.weights.reserve(edges.size());
  for (size_t e = 0; e < edges.size(); ++e) {
    double weight = 0;
    for (const int32_t side : edges.sides_of(e)) {
      weight += time * area * OppositeCotangent(mesh, side) / 2;
    }
    system.weights.push_back(weight);
    system.diagonal[edges.ends[e][0]] += weight;
    system.diagonal[edges.ends[e][1]] += weight;
  }
  return system;
}

}  // namespace

absl::Status SmoothImplicitly(const MeshEdges& edges, double time,
                              const StopToken& stop, TriangleMesh& mesh) {
  const System system = BuildSystem(mesh, edges, time);
  const Eigen::VectorXd inverse = system.diagonal.cwiseInverse();
  VertexMatrix product;
  system.Apply(mesh.V, product);
  VertexMatrix residual = system.masses.asDiagonal() * mesh.V - product;
  VertexMatrix scaled = inverse.asDiagonal() * residual;
  VertexMatrix direction = scaled;
  double error = residual.cwiseProduct(scaled).sum();
  const double goal = kTolerance * kTolerance * error;
  for (int round = 0; round < kMaxRounds && error > goal; ++round) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    system.Apply(direction, product);
    const double step = error / direction.cwiseProduct(product).sum();
    mesh.V += step * direction;
    residual -= step * product;
    scaled = inverse.asDiagonal() * residual;
    const double next = residual.cwiseProduct(scaled).sum();
    direction = scaled + next / error * direction;
    error = next;
  }
  return absl::OkStatus();
}

}  // namespace argmesh
