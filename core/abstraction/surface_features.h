// What is measured at every sample of a surface before it is decomposed.
//
// Input    a resampled surface of area 1 around the origin.
// Fails    what its parts fail with; kCancelled, kDeadlineExceeded
// Cost     about 0.15 s for 3,000 samples. Thread-safe.
#ifndef ARGMESH_CORE_ABSTRACTION_SURFACE_FEATURES_H_
#define ARGMESH_CORE_ABSTRACTION_SURFACE_FEATURES_H_

#include <Eigen/Core>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/geometry/surface_graph.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct FeatureOptions {
  double curvature_radius = 0.05;  // of the geodesic ball, sqrt(area)
  double normal_radius = 0.03;     // over which normals are averaged
  int shape_diameter_rays = 24;    // 3 .. 1000
  int geodesic_sources = 64;       // for the average geodesic distance
  int eigenpairs = 60;             // for the wave kernel signature
};

// Where logarithms of shape diameters are taken, what is thinner counts as this
// thick.
inline constexpr double kMinDiameter = 1e-3;

// n samples; distances in sqrt(area), so the surface's area is 1.
struct SurfaceFeatures {
  Eigen::VectorXd areas;             // n, sum 1
  VertexMatrix normals;              // n x 3, unit, smoothed
  Eigen::VectorXd mean_curvature;    // n, H * sqrt(A)
  Eigen::VectorXd gauss_curvature;   // n, K * A
  Eigen::VectorXd shape_diameter;    // n, > 0
  Eigen::VectorXd average_geodesic;  // n, >= 0
  Eigen::MatrixXd wave_kernel;       // n x 16
};

absl::StatusOr<SurfaceFeatures> ComputeSurfaceFeatures(
    const TriangleMesh& samples, const SurfaceGraph& geodesic_graph,
    const FeatureOptions& options = {}, const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_ABSTRACTION_SURFACE_FEATURES_H_
