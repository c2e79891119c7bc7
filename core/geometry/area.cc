#include "core/geometry/area.h"

#include <Eigen/Geometry>

namespace argmesh {
namespace {

struct Corners {
  Eigen::Vector3d a, b, c;
};

Corners FaceCorners(const TriangleMesh& mesh, int f) {
  return {mesh.vertex(mesh.F(f, 0)), mesh.vertex(mesh.F(f, 1)),
          mesh.vertex(mesh.F(f, 2))};
}

// Shares of a triangle's area that belong to its corners.
Eigen::Vector3d MixedShares(const Corners& t, double area) {
  const Eigen::Vector3d ab = t.b - t.a;
  const Eigen::Vector3d bc = t.c - t.b;
  const Eigen::Vector3d ca = t.a - t.c;
  // |u||v| cos of the angle at each corner.
  const Eigen::Vector3d dots(-ab.dot(ca), -bc.dot(ab), -ca.dot(bc));
  for (int k = 0; k < 3; ++k) {
    if (dots[k] < 0) {
      Eigen::Vector3d shares = Eigen::Vector3d::Constant(area / 4);
      shares[k] = area / 2;
      return shares;
    }
  }
  const Eigen::Vector3d cots = dots / (2 * area);
  const double ab_part = ab.squaredNorm() * cots[2] / 8;
  const double bc_part = bc.squaredNorm() * cots[0] / 8;
  const double ca_part = ca.squaredNorm() * cots[1] / 8;
  return {ab_part + ca_part, ab_part + bc_part, bc_part + ca_part};
}

}  // namespace

Eigen::VectorXd ComputeFaceAreas(const TriangleMesh& mesh) {
  Eigen::VectorXd areas(mesh.num_faces());
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Corners t = FaceCorners(mesh, f);
    areas[f] = (t.b - t.a).cross(t.c - t.a).norm() / 2;
  }
  return areas;
}

Eigen::VectorXd ComputeVertexAreas(const TriangleMesh& mesh) {
  const Eigen::VectorXd face_areas = ComputeFaceAreas(mesh);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.num_vertices());
  for (int f = 0; f < mesh.num_faces(); ++f) {
    if (face_areas[f] <= 0) continue;
    const Eigen::Vector3d shares =
        MixedShares(FaceCorners(mesh, f), face_areas[f]);
    for (int k = 0; k < 3; ++k) areas[mesh.F(f, k)] += shares[k];
  }
  return areas;
}

VertexMatrix ComputeVertexNormals(const TriangleMesh& mesh) {
  VertexMatrix normals = VertexMatrix::Zero(mesh.num_vertices(), 3);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Corners t = FaceCorners(mesh, f);
    const Eigen::RowVector3d twice_area =
        (t.b - t.a).cross(t.c - t.a).transpose();
    for (int k = 0; k < 3; ++k) normals.row(mesh.F(f, k)) += twice_area;
  }
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0) normals.row(v) /= length;
  }
  return normals;
}

}  // namespace argmesh
