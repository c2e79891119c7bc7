#include "core/synthesis/mesh_similarity.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/random.h"

namespace argmesh {
namespace {

Eigen::Matrix3d RandomRotation(Random& random) {
  Eigen::Vector4d q;
  do {
    for (int i = 0; i < 4; ++i) q[i] = random.Normal();
  } while (q.norm() < 1e-6);
  q.normalize();
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

// Fisher-Yates.
std::vector<int32_t> RandomOrder(int size, Random& random) {
  std::vector<int32_t> order(static_cast<size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  for (size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[random.Below(i)]);
  }
  return order;
}

TriangleMesh Renumber(const TriangleMesh& mesh, Random& random) {
  const std::vector<int32_t> new_vertex =
      RandomOrder(mesh.num_vertices(), random);
  const std::vector<int32_t> new_face = RandomOrder(mesh.num_faces(), random);
  TriangleMesh shuffled;
  shuffled.V.resize(mesh.V.rows(), 3);
  shuffled.F.resize(mesh.F.rows(), 3);
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    shuffled.V.row(new_vertex[static_cast<size_t>(v)]) = mesh.V.row(v);
  }
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const int first = static_cast<int>(random.Below(3));
    for (int k = 0; k < 3; ++k) {
      const int32_t v = mesh.F(f, (first + k) % 3);
      shuffled.F(new_face[static_cast<size_t>(f)], k) =
          new_vertex[static_cast<size_t>(v)];
    }
  }
  return shuffled;
}

}  // namespace

TriangleMesh RandomSimilarity(const TriangleMesh& mesh, uint64_t seed,
                              const SimilarityOptions& options) {
  if (mesh.num_vertices() == 0) return mesh;
  Random random(seed);
  const Eigen::Matrix3d rotation = RandomRotation(random);
  const double scale =
      std::exp(random.Uniform(-options.max_log_scale, options.max_log_scale));
  const Eigen::RowVector3d size =
      mesh.V.colwise().maxCoeff() - mesh.V.colwise().minCoeff();
  Eigen::RowVector3d shift;
  for (int axis = 0; axis < 3; ++axis) {
    shift[axis] = size.norm() * random.Uniform(-options.max_translation,
                                               options.max_translation);
  }
  TriangleMesh moved = mesh;
  moved.V = (scale * mesh.V * rotation.transpose()).rowwise() + shift;
  return options.renumber ? Renumber(moved, random) : moved;
}

TriangleMesh RemoveFaces(const TriangleMesh& mesh, double share,
                         uint64_t seed) {
  Random random(seed);
  std::vector<int> kept;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    if (random.Uniform() >= share) kept.push_back(f);
  }
  TriangleMesh rest;
  rest.V = mesh.V;
  rest.F.resize(static_cast<Eigen::Index>(kept.size()), 3);
  for (size_t f = 0; f < kept.size(); ++f) {
    rest.F.row(static_cast<Eigen::Index>(f)) = mesh.F.row(kept[f]);
  }
  RemoveUnusedVertices(rest);
  return rest;
}

TriangleMesh MakeSoup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  soup.V.resize(mesh.F.rows() * 3, 3);
  soup.F.resize(mesh.F.rows(), 3);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      soup.V.row(3 * f + k) = mesh.V.row(mesh.F(f, k));
      soup.F(f, k) = 3 * f + k;
    }
  }
  return soup;
}

}  // namespace argmesh
