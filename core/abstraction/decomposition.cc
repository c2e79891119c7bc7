#include "core/abstraction/decomposition.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "absl/strings/str_format.h"
#include "core/abstraction/first_stage.h"
#include "core/abstraction/normalized_cut.h"
#include "core/abstraction/region_graph.h"
#include "core/abstraction/voronoi_regions.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr int kMaxComponents = 1000;

absl::Status CheckRange(const char* name, double value, double low,
                        double high) {
  if (value >= low && value <= high) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrFormat("decomposition option %s is %g, must be %g to %g", name,
                      value, low, high));
}

absl::Status CheckBiharmonic(const BiharmonicOptions& o) {
  ARGMESH_RETURN_IF_ERROR(CheckRange("eigenvectors", o.eigenvectors, 1, 100));
  ARGMESH_RETURN_IF_ERROR(CheckRange("min_window", o.min_window, 1e-4, 10));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("max_window", o.max_window, o.min_window, 10));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("window_growth", o.window_growth, 1.01, 10));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("concavity_width", o.concavity_width, 1e-3, 100));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("thickness_width", o.thickness_width, 1e-3, 100));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("min_conductance", o.min_conductance, 1e-6, 1));
  return CheckRange("super_samples", o.super_samples, 10, 100'000);
}

absl::Status CheckOptions(const DecompositionOptions& o) {
  ARGMESH_RETURN_IF_ERROR(CheckBiharmonic(o.biharmonic));
  const NormalCurvatureOptions& n = o.normal_curvature;
  ARGMESH_RETURN_IF_ERROR(CheckRange("min_window", n.min_window, 1e-3, 1));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("max_window", n.max_window, n.min_window, 1));
  ARGMESH_RETURN_IF_ERROR(CheckRange("window_step", n.window_step, 1e-3, 1));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("range_bandwidth", n.range_bandwidth, 1e-3, 100));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("mode_distance_scale", n.mode_distance_scale, 1e-3, 100));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("voronoi_cells", o.voronoi_cells, 2, kMaxComponents));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("min_region_area", o.min_region_area, 0, 0.5));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("max_regions", o.max_regions, 1, kMaxComponents));
  if (!std::is_sorted(o.level_thresholds.begin(), o.level_thresholds.end()) ||
      !std::is_sorted(o.level_counts.begin(), o.level_counts.end())) {
    return absl::InvalidArgumentError(
        "decomposition options level_thresholds and level_counts must ascend");
  }
  if (o.level_thresholds.empty() && o.level_counts.empty()) {
    return absl::InvalidArgumentError("decomposition options name no level");
  }
  for (const int count : o.level_counts) {
    ARGMESH_RETURN_IF_ERROR(
        CheckRange("level_counts", count, 1, kMaxComponents));
  }
  return absl::OkStatus();
}

// Equation 3: w = exp(-d / sigma), d the mean Euclidean distance between the
// modes of two regions.
CutProblem MakeModeDistanceProblem(const DecompositionInput& input,
                                   const RegionGraph& regions,
                                   const std::vector<Mode>& modes,
                                   double scale) {
  const int count = regions.num_regions();
  std::vector<std::vector<Eigen::Vector3d>> points(static_cast<size_t>(count));
  for (const Mode& mode : modes) {
    points[static_cast<size_t>(mode.region)].push_back(
        input.samples.vertex(mode.sample));
  }
  std::vector<Eigen::Vector3d> center(static_cast<size_t>(count),
                                      Eigen::Vector3d::Zero());
  for (int v = 0; v < input.samples.num_vertices(); ++v) {
    const auto region =
        static_cast<size_t>(regions.region_of_sample[static_cast<size_t>(v)]);
    center[region] += input.features.areas[v] * input.samples.vertex(v);
  }
  for (size_t r = 0; r < points.size(); ++r) {
    if (!points[r].empty()) continue;  // absorbed its mode elsewhere
    points[r].push_back(center[r] /
                        regions.areas[static_cast<Eigen::Index>(r)]);
  }
  CutProblem problem;
  problem.weights = Eigen::MatrixXd::Zero(count, count);
  for (int a = 0; a < count; ++a) {
    for (int b = 0; b < a; ++b) {
      double sum = 0;
      const auto& pa = points[static_cast<size_t>(a)];
      const auto& pb = points[static_cast<size_t>(b)];
      for (const auto& p : pa) {
        for (const auto& q : pb) sum += (p - q).norm();
      }
      const double mean = sum / static_cast<double>(pa.size() * pb.size());
      problem.weights(a, b) = problem.weights(b, a) = std::exp(-mean / scale);
    }
  }
  problem.masses = problem.weights.rowwise().sum().array() + 1;
  problem.mass_exponent = 1;
  return problem;
}

CutProblem MakeBorderProblem(const RegionGraph& regions) {
  CutProblem problem;
  problem.weights = regions.borders;
  problem.masses = regions.areas;
  problem.mass_exponent = 0.5;
  return problem;
}

absl::StatusOr<FirstStage> RunFirstStage(const DecompositionInput& input,
                                         const DecompositionOptions& options,
                                         const StopToken& stop) {
  if (options.kind == DecompositionKind::kNormalCurvature) {
    return FindNormalCurvatureModes(input, options.normal_curvature, stop);
  }
  if (options.kind == DecompositionKind::kBiharmonic) {
    return FindBiharmonicModes(input, options.biharmonic, stop);
  }
  if (input.given_labels.size() !=
      static_cast<size_t>(input.samples.num_vertices())) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%d given labels for %d samples", input.given_labels.size(),
        input.samples.num_vertices()));
  }
  FirstStage stage;
  stage.label_of_sample.assign(input.given_labels.begin(),
                               input.given_labels.end());
  stage.link_weights.assign(input.edge_graph.targets.size(), 1.0);
  return stage;
}

}  // namespace

std::string_view DecompositionName(DecompositionKind kind) {
  switch (kind) {
    case DecompositionKind::kBiharmonic:
      return "biharmonic";
    case DecompositionKind::kNormalCurvature:
      return "normal-curvature";
    case DecompositionKind::kVoronoi:
      return "voronoi";
    case DecompositionKind::kGiven:
      return "given";
  }
  return "unknown";
}

DecompositionOptions DecompositionOptionsFor(DecompositionKind kind) {
  DecompositionOptions options;
  options.kind = kind;
  if (kind == DecompositionKind::kNormalCurvature ||
      kind == DecompositionKind::kVoronoi) {
    options.level_thresholds.clear();
    options.level_counts = {4, 8, 16};
    options.voronoi_cells = options.level_counts.back();
  }
  if (kind == DecompositionKind::kNormalCurvature) {
    options.min_region_area = 0.0015;
    options.max_regions = 64;
  }
  if (kind == DecompositionKind::kGiven) options.min_region_area = 0;
  return options;
}

std::vector<int32_t> Decomposition::ComponentOfSample(int level) const {
  const std::vector<int32_t>& component =
      levels[static_cast<size_t>(level)].component_of_region;
  std::vector<int32_t> result;
  result.reserve(region_of_sample.size());
  for (const int32_t region : region_of_sample) {
    result.push_back(component[static_cast<size_t>(region)]);
  }
  return result;
}

absl::StatusOr<Decomposition> DecomposeSurface(
    const DecompositionInput& input, const DecompositionOptions& options,
    const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(CheckOptions(options));
  if (options.kind == DecompositionKind::kVoronoi) {
    return DecomposeByVoronoi(input, options);
  }
  ARGMESH_ASSIGN_OR_RETURN(FirstStage stage,
                           RunFirstStage(input, options, stop));
  RegionOptions region_options;
  region_options.min_area = options.min_region_area;
  region_options.max_regions = options.max_regions;
  RegionGraph regions = BuildRegionGraph(input.edge_graph, input.features.areas,
                                         stage.link_weights,
                                         stage.label_of_sample, region_options);
  ARGMESH_RETURN_IF_ERROR(stop.Check());

  Decomposition result;
  result.modes = std::move(stage.modes);
  for (Mode& mode : result.modes) {
    mode.region = regions.region_of_sample[static_cast<size_t>(mode.sample)];
  }
  const CutProblem problem =
      options.kind == DecompositionKind::kNormalCurvature
          ? MakeModeDistanceProblem(
                input, regions, result.modes,
                options.normal_curvature.mode_distance_scale)
          : MakeBorderProblem(regions);
  result.cut_tree = BuildCutTree(problem);
  result.levels = CutLevels(result.cut_tree, options.level_thresholds,
                            options.level_counts);
  result.num_regions = regions.num_regions();
  result.region_of_sample = std::move(regions.region_of_sample);
  return result;
}

}  // namespace argmesh
