#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "core/geometry/spectrum.h"

namespace argmesh {
namespace {

// Position of the link v -> target, an edge of the mesh, in graph.targets.
int32_t FindLink(const SurfaceGraph& graph, int32_t v, int32_t target) {
  const auto first = graph.targets.begin() + graph.offsets.data()[v];
  const auto last = graph.targets.begin() + graph.offsets.data()[v + 1];
  return static_cast<int32_t>(std::lower_bound(first, last, target) -
                              graph.targets.begin());
}

}  // namespace

std::vector<double> ComputeCotangentWeights(const TriangleMesh& mesh,
                                            const SurfaceGraph& graph,
                                            const CotangentOptions& options) {
  std::vector<double> weights(graph.targets.size(), 0);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int32_t a = mesh.F(f, (k + 1) % 3);
      const int32_t b = mesh.F(f, (k + 2) % 3);
      if (a == b) continue;
      const Eigen::Vector3d u = mesh.vertex(a) - mesh.vertex(mesh.F(f, k));
      const Eigen::Vector3d w = mesh.vertex(b) - mesh.vertex(mesh.F(f, k));
      const double twice_area = u.cross(w).norm();
      if (!(twice_area > 0)) continue;
      const double half =
          std::clamp(u.dot(w) / twice_area, -options.max_cotangent,
                     options.max_cotangent) /
          2;
      weights.data()[FindLink(graph, a, b)] += half;
      weights.data()[FindLink(graph, b, a)] += half;
    }
  }
  for (size_t e = 0; e < weights.size(); ++e) {
    switch (graph.kinds[e]) {
      case LinkKind::kEdge:
        weights[e] =
            std::clamp(weights[e], options.min_weight, options.max_weight);
        break;
      case LinkKind::kDiagonal:
        weights[e] = 0;
        break;
      case LinkKind::kBridge:
        weights[e] = options.bridge_weight;
        break;
    }
  }
  return weights;
}

Eigen::SparseMatrix<double> BuildLaplacian(const SurfaceGraph& graph,
                                           const std::vector<double>& weights) {
  const int n = graph.num_vertices();
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.reserve(static_cast<Eigen::Index>(weights.size()) + n);
  for (int32_t v = 0; v < n; ++v) {
    const int32_t begin = graph.offsets.data()[v];
    const int32_t end = graph.offsets.data()[v + 1];
    const double degree =
        std::accumulate(weights.begin() + begin, weights.begin() + end, 0.0);
    laplacian.startVec(v);
    int32_t e = begin;
    const auto insert_until = [&](int32_t limit) {
      for (; e < end && graph.targets.data()[e] < limit; ++e) {
        const double weight = weights.data()[e];
        if (weight != 0) {
          laplacian.insertBack(graph.targets.data()[e], v) = -weight;
        }
      }
    };
    insert_until(v);
    laplacian.insertBack(v, v) = degree;
    insert_until(n);
  }
  laplacian.finalize();
  return laplacian;
}

}  // namespace argmesh
