#include "core/containment/window_extraction.h"

#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/base/status_macros.h"
#include "core/containment/open_orientation.h"
#include "core/geometry/area.h"

namespace argmesh {
namespace {

constexpr float kSpacing = 0.5F;     // of centres, in radii
constexpr double kMinSamples = 160;  // in a flat window
constexpr size_t kSmallestLayer = 512;
constexpr size_t kWindowsPerCheck = 64;

// Heads of the samples, each half as long as the one before.
std::vector<SampleLayer> MakeLayers(const SurfaceSamples& samples) {
  std::vector<SampleLayer> layers;
  for (size_t n = samples.positions.size();; n /= 2) {
    SampleLayer layer;
    layer.tree = PointTree(std::span(samples.positions).first(n));
    layer.normals.reserve(n);
    for (const int32_t number : layer.tree.numbers()) {
      layer.normals.push_back(samples.normals[static_cast<size_t>(number)]);
    }
    layers.push_back(std::move(layer));
    if (n / 2 < kSmallestLayer) return layers;
  }
}

// The coarsest layer that shows enough of a window.
const SampleLayer& LayerForRadius(const std::vector<SampleLayer>& layers,
                                  float radius) {
  size_t l = 0;
  while (l + 1 < layers.size() && static_cast<double>(layers[l].tree.size()) *
                                          std::numbers::pi * radius * radius >=
                                      kMinSamples) {
    ++l;
  }
  return layers[l];
}

// Samples no two of which lie within `spacing` on one side of the surface;
// greedy in the order of the samples.
std::vector<int32_t> ChooseCenters(const SurfaceSamples& samples,
                                   const SampleLayer& layer,
                                   const PointTree& boundary, float radius,
                                   const ExtractionPlan& plan) {
  const auto margin = static_cast<float>(plan.boundary_margin) * radius;
  std::vector<char> taken(layer.tree.size(), 0);  // by number
  std::vector<int32_t> centers;
  for (size_t i = 0; i < taken.size(); ++i) {
    if (taken[i]) continue;
    if (static_cast<int>(centers.size()) >= plan.accept_cap) break;
    const Eigen::Vector3f& p = samples.positions[i];
    if (boundary.FindNearest(p, margin * margin).place >= 0) continue;
    centers.push_back(static_cast<int32_t>(i));
    const Eigen::Vector3f& n = samples.normals[i];
    layer.tree.VisitBall(p, kSpacing * radius, [&](int32_t place, float) {
      const auto at = static_cast<size_t>(place);
      if (layer.normals[at].dot(n) > 0) {
        taken[static_cast<size_t>(layer.tree.numbers()[at])] = 1;
      }
    });
  }
  return centers;
}

absl::StatusOr<RawLevel> ExtractLevel(const SurfaceSamples& samples,
                                      const SampleLayer& layer,
                                      const OpenBoundary& boundary,
                                      float radius, const ExtractionPlan& plan,
                                      const StopToken& stop) {
  const std::vector<int32_t> centers = ChooseCenters(
      samples, layer, BoundaryForRadius(boundary, radius), radius, plan);
  RawLevel level;
  level.accepted = static_cast<int32_t>(centers.size());
  const size_t described =
      std::min(centers.size(), static_cast<size_t>(plan.describe_cap));
  level.windows.reserve(described);
  for (size_t i = 0; i < described; ++i) {
    if (i % kWindowsPerCheck == 0) ARGMESH_RETURN_IF_ERROR(stop.Check());
    const auto center = static_cast<size_t>(centers[i]);
    level.windows.push_back(DescribeWindow(layer, samples.positions[center],
                                           samples.normals[center], radius));
  }
  return level;
}

}  // namespace

ExtractionPlan TargetPlan(int level_cap, uint64_t seed) {
  ExtractionPlan plan;
  plan.accept_cap = plan.describe_cap = level_cap;
  plan.seed = seed;
  return plan;
}

float LevelRadius(double first_radius, int level) {
  return static_cast<float>(first_radius * std::exp2(level / 2.0));
}

absl::StatusOr<RawWindowSet> ExtractRawWindows(const TriangleMesh& repaired,
                                               const ExtractionPlan& plan,
                                               const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(CheckMesh(repaired));
  const Eigen::VectorXd areas = ComputeFaceAreas(repaired);
  if (!(areas.sum() > 0 && std::isfinite(areas.sum()))) {
    return absl::FailedPreconditionError(
        "windows need a face of positive, finite area");
  }
  RawWindowSet set;
  TriangleMesh mesh = ToUnitArea(repaired, areas, set.frame);
  const OpenBoundary boundary = FindOpenBoundary(mesh);
  if (plan.orient_open && !boundary.points.empty()) OrientOpenPieces(mesh);
  set.samples =
      SampleSurface(mesh, ComputeFaceAreas(mesh), plan.num_samples, plan.seed);
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  const std::vector<SampleLayer> layers = MakeLayers(set.samples);
  for (int l = 0; l < plan.num_levels; ++l) {
    const float radius = LevelRadius(plan.first_radius, l);
    ARGMESH_ASSIGN_OR_RETURN(
        RawLevel level,
        ExtractLevel(set.samples, LayerForRadius(layers, radius), boundary,
                     radius, plan, stop));
    set.levels.push_back(std::move(level));
  }
  return set;
}

}  // namespace argmesh
