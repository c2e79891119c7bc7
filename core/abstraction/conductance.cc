#include "core/abstraction/conductance.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/spectrum.h"

namespace argmesh {
namespace {

// A jump of one octave in shape diameter over this length costs as much as a
// crease of the same dimensionless strength.
constexpr double kThicknessLength = 0.02;
constexpr double kMinSquaredLength = 1e-12;

}  // namespace

std::vector<double> ComputeConductances(const TriangleMesh& samples,
                                        const SurfaceFeatures& features,
                                        const SurfaceGraph& graph,
                                        const BiharmonicOptions& options) {
  CotangentOptions cotangent;
  cotangent.min_weight = 0.1;
  cotangent.max_weight = 2;
  std::vector<double> conductances =
      ComputeCotangentWeights(samples, graph, cotangent);
  const Eigen::VectorXd log_diameter =
      features.shape_diameter.array().max(kMinDiameter).log() / std::log(2.0);
  for (int v = 0; v < graph.num_vertices(); ++v) {
    const auto first =
        static_cast<size_t>(graph.offsets[static_cast<size_t>(v)]);
    const auto last =
        static_cast<size_t>(graph.offsets[static_cast<size_t>(v) + 1]);
    for (size_t link = first; link < last; ++link) {
      const int u = graph.targets[link];
      const Eigen::Vector3d d = samples.vertex(u) - samples.vertex(v);
      const double squared = std::max(d.squaredNorm(), kMinSquaredLength);
      // Normal curvature along the link: negative where it is concave.
      const double curvature =
          (features.normals.row(u) - features.normals.row(v)).dot(d) / squared;
      const double concavity = std::max(
          0.0, -options.concavity_scale * curvature - options.concavity_floor);
      const double thickness = kThicknessLength *
                               std::abs(log_diameter[u] - log_diameter[v]) /
                               std::sqrt(squared);
      const double factor = std::exp(-concavity / options.concavity_width -
                                     thickness / options.thickness_width);
      conductances[link] *= std::max(options.min_conductance, factor);
    }
  }
  return conductances;
}

}  // namespace argmesh
