#include "core/synthesis/mesh_noise.h"

#include <Eigen/Geometry>

#include "core/base/random.h"

namespace argmesh {

TriangleMesh AddNoise(const TriangleMesh& mesh, double share, uint64_t seed) {
  TriangleMesh noisy = mesh;
  if (mesh.num_vertices() == 0) return noisy;
  VertexMatrix normals = VertexMatrix::Zero(mesh.V.rows(), 3);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d a = mesh.vertex(mesh.F(f, 0));
    const Eigen::Vector3d cross =
        (mesh.vertex(mesh.F(f, 1)) - a).cross(mesh.vertex(mesh.F(f, 2)) - a);
    for (int k = 0; k < 3; ++k) normals.row(mesh.F(f, k)) += cross.transpose();
  }
  const Eigen::RowVector3d size =
      mesh.V.colwise().maxCoeff() - mesh.V.colwise().minCoeff();
  const double deviation = share * size.norm();
  Random random(seed);
  for (Eigen::Index v = 0; v < noisy.V.rows(); ++v) {
    const double length = deviation * random.Normal();
    const double norm = normals.row(v).norm();
    if (norm > 0) noisy.V.row(v) += length / norm * normals.row(v);
  }
  return noisy;
}

}  // namespace argmesh
