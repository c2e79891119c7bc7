#include "core/mesh/plane_quadric.h"

#include <Eigen/Dense>

#include "core/mesh/mesh_weld.h"

namespace argmesh {
namespace {

constexpr double kTiny = 1e-300;  // no direction can be taken from less

}  // namespace

void PlaneQuadric::AddPlane(const Eigen::Vector3d& normal,
                            const Eigen::Vector3d& point, double weight) {
  const double offset = -normal.dot(point);
  A_ += weight * normal * normal.transpose();
  b_ -= weight * offset * normal;
  c_ += weight * offset * offset;
  weight_ += weight;
}

PlaneQuadric& PlaneQuadric::operator+=(const PlaneQuadric& other) {
  A_ += other.A_;
  b_ += other.b_;
  c_ += other.c_;
  weight_ += other.weight_;
  return *this;
}

double PlaneQuadric::SumAt(const Eigen::Vector3d& x) const {
  return x.dot(A_ * x) - 2 * b_.dot(x) + c_;
}

Eigen::Vector3d PlaneQuadric::Lowest(const Eigen::Vector3d& rest,
                                     double pull) const {
  Eigen::Matrix3d M = A_;
  M.diagonal().array() += pull * weight_;
  return M.inverse() * (b_ + pull * weight_ * rest);
}

std::vector<PlaneQuadric> ComputeVertexQuadrics(const TriangleMesh& mesh,
                                                const MeshEdges& edges) {
  std::vector<PlaneQuadric> quadrics(Slot(mesh.num_vertices()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d cross = FaceCross(mesh, f);
    const double length = cross.norm();
    if (length < kTiny) continue;
    PlaneQuadric plane;
    plane.AddPlane(cross / length, mesh.vertex(mesh.F(f, 0)), length / 6);
    for (int c = 0; c < 3; ++c) quadrics[Slot(mesh.F(f, c))] += plane;
  }
  for (size_t e = 0; e < edges.size(); ++e) {
    if (edges.sides_of(e).size() != 1) continue;
    const auto& [a, b] = edges.ends[e];
    const Eigen::Vector3d along = mesh.vertex(b) - mesh.vertex(a);
    const Eigen::Vector3d across =
        FaceCross(mesh, edges.sides_of(e)[0] / 3).cross(along);
    const double length = across.norm();
    if (length < kTiny) continue;
    PlaneQuadric plane;
    plane.AddPlane(across / length, mesh.vertex(a), along.squaredNorm());
    quadrics[Slot(a)] += plane;
    quadrics[Slot(b)] += plane;
  }
  return quadrics;
}

}  // namespace argmesh
