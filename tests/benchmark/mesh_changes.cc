#include "tests/benchmark/mesh_changes.h"

#include "core/synthesis/mesh_cut.h"
#include "core/synthesis/mesh_decimate.h"
#include "core/synthesis/mesh_noise.h"
#include "core/synthesis/mesh_similarity.h"

namespace argmesh {
namespace {

TriangleMesh Similar(const TriangleMesh& mesh, uint64_t seed) {
  return RandomSimilarity(mesh, seed);
}

TriangleMesh Printed(const TriangleMesh& mesh, uint64_t seed) {
  TriangleMesh copy = RandomSimilarity(mesh, seed);
  copy.V = copy.V.cast<float>().cast<double>().eval();
  return copy;
}

template <int kPerMille>
TriangleMesh Noisy(const TriangleMesh& mesh, uint64_t seed) {
  return AddNoise(mesh, kPerMille / 1000.0, seed);
}

template <int kPerCent>
TriangleMesh Decimated(const TriangleMesh& mesh, uint64_t) {
  return DecimateMesh(mesh, mesh.num_vertices() * kPerCent / 100);
}

template <int kAxis>
TriangleMesh Half(const TriangleMesh& mesh, uint64_t) {
  return CutHalf(mesh, kAxis);
}

}  // namespace

std::span<const MeshChange> WholeMeshChanges() {
  static const MeshChange kChanges[] = {
      {"similar", &Similar, true},      {"printed", &Printed, true},
      {"noise-0.5", &Noisy<5>},         {"noise-1", &Noisy<10>},
      {"decimated-25", &Decimated<25>}, {"decimated-10", &Decimated<10>},
  };
  return kChanges;
}

std::span<const MeshChange> HalfMeshChanges() {
  static const MeshChange kChanges[] = {
      {"half-x", &Half<0>, false, true},
      {"half-y", &Half<1>, false, true},
      {"half-z", &Half<2>, false, true},
  };
  return kChanges;
}

Eigen::Affine3d MotionOf(const TriangleMesh& mesh, uint64_t seed) {
  SimilarityOptions options;
  options.renumber = false;
  const TriangleMesh moved = RandomSimilarity(mesh, seed, options);
  return Eigen::Affine3d(
      Eigen::umeyama(mesh.V.transpose(), moved.V.transpose()));
}

}  // namespace argmesh
