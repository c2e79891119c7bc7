#include "core/abstraction/surface_features.h"

#include "core/base/status_macros.h"
#include "core/geometry/area.h"
#include "core/geometry/curvature.h"
#include "core/geometry/geodesic.h"
#include "core/geometry/shape_diameter.h"
#include "core/geometry/spectrum.h"

namespace argmesh {
namespace {

// Samples of no area would divide by zero wherever areas weigh a mean.
constexpr double kMinSampleArea = 1e-9;

}  // namespace

absl::StatusOr<SurfaceFeatures> ComputeSurfaceFeatures(
    const TriangleMesh& samples, const SurfaceGraph& geodesic_graph,
    const FeatureOptions& options, const StopToken& stop) {
  SurfaceFeatures features;
  features.areas =
      ComputeVertexAreas(samples).array().max(kMinSampleArea).matrix();
  features.areas /= features.areas.sum();
  features.normals = ComputeSmoothedNormals(
      samples, ComputeVertexNormals(samples), features.areas, geodesic_graph,
      options.normal_radius);
  ARGMESH_RETURN_IF_ERROR(stop.Check());

  Curvatures curvatures = ComputeCurvatures(
      samples, features.normals, geodesic_graph, options.curvature_radius);
  features.mean_curvature = std::move(curvatures.mean);
  features.gauss_curvature = std::move(curvatures.gaussian);
  ARGMESH_RETURN_IF_ERROR(stop.Check());

  ShapeDiameterOptions diameter;
  diameter.num_rays = options.shape_diameter_rays;
  ARGMESH_ASSIGN_OR_RETURN(features.shape_diameter,
                           ComputeShapeDiameter(samples, features.normals,
                                                geodesic_graph, diameter));
  ARGMESH_RETURN_IF_ERROR(stop.Check());

  features.average_geodesic = ComputeAverageGeodesicDistance(
      geodesic_graph, features.areas, options.geodesic_sources);
  ARGMESH_RETURN_IF_ERROR(stop.Check());

  const std::vector<double> weights =
      ComputeCotangentWeights(samples, geodesic_graph);
  const int count =
      std::max(1, std::min(options.eigenpairs, samples.num_vertices() - 2));
  ARGMESH_ASSIGN_OR_RETURN(
      const Spectrum spectrum,
      ComputeSpectrum(BuildLaplacian(geodesic_graph, weights), features.areas,
                      count, stop));
  features.wave_kernel = ComputeWaveKernelSignature(spectrum);
  return features;
}

}  // namespace argmesh
