#include "core/abstraction/decomposition.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
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

struct OptionRange {
  const char* name;
  double value, low, high;
};

absl::Status CheckRanges(std::initializer_list<OptionRange> options) {
  for (const OptionRange& o : options) {
    if (o.value >= o.low && o.value <= o.high) continue;
    return absl::InvalidArgumentError(
        absl::StrFormat("decomposition option %s is %g, must be %g to %g",
                        o.name, o.value, o.low, o.high));
  }
  return absl::OkStatus();
}

absl::Status CheckBiharmonic(const BiharmonicOptions& o) {
  return CheckRanges(
      {{"eigenvectors", static_cast<double>(o.eigenvectors), 1, 100},
       {"min_window", o.min_window, 1e-4, 10},
       {"max_window", o.max_window, o.min_window, 10},
       {"window_growth", o.window_growth, 1.01, 10},
       {"concavity_width", o.concavity_width, 1e-3, 100},
       {"thickness_width", o.thickness_width, 1e-3, 100},
       {"min_conductance", o.min_conductance, 1e-6, 1},
       {"super_samples", static_cast<double>(o.super_samples), 10, 100'000}});
}

absl::Status CheckNormalCurvature(const NormalCurvatureOptions& o) {
  return CheckRanges(
      {{"min_window", o.min_window, 1e-3, 1},
       {"max_window", o.max_window, o.min_window, 1},
       {"window_step", o.window_step, 1e-3, 1},
       {"range_bandwidth", o.range_bandwidth, 1e-3, 100},
       {"mode_distance_scale", o.mode_distance_scale, 1e-3, 100}});
}

absl::Status CheckLevels(const DecompositionOptions& o) {
  if (!std::is_sorted(o.level_thresholds.begin(), o.level_thresholds.end()) ||
      !std::is_sorted(o.level_counts.begin(), o.level_counts.end())) {
    return absl::InvalidArgumentError(
        "decomposition options level_thresholds and level_counts must ascend");
  }
  if (o.level_thresholds.empty() && o.level_counts.empty()) {
    return absl::InvalidArgumentError("decomposition options name no level");
  }
  for (const int count : o.level_counts) {
    ARGMESH_RETURN_IF_ERROR(CheckRanges(
        {{"level_counts", static_cast<double>(count), 1, kMaxComponents}}));
  }
  return absl::OkStatus();
}

absl::Status CheckOptions(const DecompositionOptions& o) {
  ARGMESH_RETURN_IF_ERROR(CheckBiharmonic(o.biharmonic));
  ARGMESH_RETURN_IF_ERROR(CheckNormalCurvature(o.normal_curvature));
  ARGMESH_RETURN_IF_ERROR(
      CheckRanges({{"voronoi_cells", static_cast<double>(o.voronoi_cells), 2,
                    kMaxComponents},
                   {"min_region_area", o.min_region_area, 0, 0.5},
                   {"max_regions", static_cast<double>(o.max_regions), 1,
                    kMaxComponents}}));
  return CheckLevels(o);
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
