#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "core/abstraction/first_stage.h"
#include "core/base/status_macros.h"
#include "core/geometry/geodesic.h"

namespace argmesh {
namespace {

// The range part of the joint space: normal, mean and Gaussian curvature, each
// brought to about [-0.5, 0.5].
constexpr int kRangeDim = 5;
constexpr double kRangeWeight = 0.5;
constexpr double kCurvatureScale = 0.15;  // sqrt(area)
// A grown window is taken over by the samples it covers that are this alike.
constexpr double kMinRangeKernel = 0.3;
constexpr int kStopInterval = 256;  // samples between two looks at the token

using RangeMatrix = Eigen::Matrix<double, kRangeDim, Eigen::Dynamic>;

RangeMatrix MakeRange(const SurfaceFeatures& features) {
  constexpr double kSquash = kRangeWeight * 2 / std::numbers::pi;
  RangeMatrix range(kRangeDim, features.areas.size());
  range.topRows<3>() = kRangeWeight * features.normals.transpose();
  range.row(3) =
      kSquash *
      (kCurvatureScale * features.mean_curvature.array()).atan().transpose();
  range.row(4) = kSquash * (kCurvatureScale * kCurvatureScale *
                            features.gauss_curvature.array())
                               .atan()
                               .transpose();
  return range;
}

struct WindowState {
  double density = 0;  // joint mass over w^2
  double share = 0;    // f: joint mass over spatial mass
  double offset = 0;   // |delta| in units of the windows
};

class ModeSeeker {
 public:
  ModeSeeker(const DecompositionInput& input,
             const NormalCurvatureOptions& options)
      : input_(input),
        options_(options),
        range_(MakeRange(input.features)),
        solver_(input.geodesic_graph),
        inverse_range_(1 /
                       (options.range_bandwidth * options.range_bandwidth)) {}

  absl::StatusOr<FirstStage> Find(const StopToken& stop);

 private:
  double RangeDistance2(int a, int b) const {
    return (range_.col(a) - range_.col(b)).squaredNorm() * inverse_range_;
  }
  WindowState Measure(int center, double window);
  int ClimbStep(int v, double window);
  absl::Status MeasureDensities(const std::vector<double>& windows,
                                const StopToken& stop);
  absl::StatusOr<std::vector<int32_t>> Climb(const std::vector<double>& windows,
                                             const StopToken& stop);
  Mode Grow(int32_t sample, std::vector<double>& windows);

  const DecompositionInput& input_;
  const NormalCurvatureOptions& options_;
  const RangeMatrix range_;
  GeodesicSolver solver_;
  const double inverse_range_;
  std::vector<double> densities_;
};

WindowState ModeSeeker::Measure(int center, double window) {
  double spatial = 0;
  double joint = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, kRangeDim, 1> range;
  range.setZero();
  for (const ReachedVertex& reached :
       solver_.FindWithin(center, static_cast<float>(window))) {
    const double ratio = reached.distance / window;
    const double mass =
        input_.features.areas[reached.vertex] * std::exp(-2 * ratio * ratio);
    const double weight =
        mass * std::exp(-0.5 * RangeDistance2(center, reached.vertex));
    spatial += mass;
    joint += weight;
    position += weight * input_.samples.vertex(reached.vertex);
    range += weight * range_.col(reached.vertex);
  }
  WindowState state;
  state.density = joint / (window * window);
  state.share = joint / spatial;
  const double shift2 =
      (position / joint - input_.samples.vertex(center)).squaredNorm() /
          (window * window) +
      (range / joint - range_.col(center)).squaredNorm() * inverse_range_;
  state.offset = std::sqrt(shift2);
  return state;
}

absl::Status ModeSeeker::MeasureDensities(const std::vector<double>& windows,
                                          const StopToken& stop) {
  densities_.resize(windows.size());
  for (size_t v = 0; v < windows.size(); ++v) {
    if (v % kStopInterval == 0) ARGMESH_RETURN_IF_ERROR(stop.Check());
    densities_[v] = Measure(static_cast<int>(v), windows[v]).density;
  }
  return absl::OkStatus();
}

// The nearest sample of higher density inside the joint window, or v itself.
int ModeSeeker::ClimbStep(int v, double window) {
  constexpr double kSpatialWeight = 4;
  constexpr double kWindowEdge = 4;
  double best = kWindowEdge;
  int next = v;
  const double own = densities_[static_cast<size_t>(v)];
  for (const ReachedVertex& reached :
       solver_.FindWithin(v, static_cast<float>(window))) {
    const double density = densities_[static_cast<size_t>(reached.vertex)];
    const bool higher = density > own || (density == own && reached.vertex < v);
    if (!higher) continue;
    const double ratio = reached.distance / window;
    const double distance =
        kSpatialWeight * ratio * ratio + RangeDistance2(v, reached.vertex);
    if (distance < best) {
      best = distance;
      next = reached.vertex;
    }
  }
  return next;
}

absl::StatusOr<std::vector<int32_t>> ModeSeeker::Climb(
    const std::vector<double>& windows, const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(MeasureDensities(windows, stop));
  const auto n = static_cast<int>(windows.size());
  std::vector<int32_t> next(windows.size());
  for (int v = 0; v < n; ++v) {
    if (v % kStopInterval == 0) ARGMESH_RETURN_IF_ERROR(stop.Check());
    next[static_cast<size_t>(v)] =
        ClimbStep(v, windows[static_cast<size_t>(v)]);
  }
  // Links go uphill (ties by index), so going down in density resolves them.
  std::vector<int32_t> order(windows.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return densities_[static_cast<size_t>(a)] >
           densities_[static_cast<size_t>(b)];
  });
  std::vector<int32_t> root(windows.size());
  for (const int32_t v : order) {
    const int32_t up = next[static_cast<size_t>(v)];
    root[static_cast<size_t>(v)] = up == v ? v : root[static_cast<size_t>(up)];
  }
  return root;
}

// Step 2 and 3 of section 3.2: larger windows until delta(m) or f(m) fails.
Mode ModeSeeker::Grow(int32_t sample, std::vector<double>& windows) {
  constexpr double kRounding = 1e-9;
  WindowState state = Measure(sample, options_.min_window);
  double stable = options_.min_window;
  Mode mode;
  mode.sample = sample;
  double w = options_.min_window + options_.window_step;
  while (w <= options_.max_window + kRounding) {
    const WindowState grown = Measure(sample, w);
    if (grown.share < options_.min_density ||
        grown.offset > options_.max_offset) {
      break;
    }
    state = grown;
    stable = w;
    ++mode.repeatability;
    w += options_.window_step;
  }
  mode.window = static_cast<float>(stable);
  mode.density = static_cast<float>(state.share);
  mode.offset = static_cast<float>(state.offset);
  if (mode.repeatability == 1) return mode;
  for (const ReachedVertex& reached :
       solver_.FindWithin(sample, static_cast<float>(stable))) {
    const double alike = std::exp(-RangeDistance2(sample, reached.vertex));
    double& window = windows[static_cast<size_t>(reached.vertex)];
    if (alike > kMinRangeKernel) window = std::max(window, stable);
  }
  return mode;
}

absl::StatusOr<FirstStage> ModeSeeker::Find(const StopToken& stop) {
  const auto n = static_cast<size_t>(input_.samples.num_vertices());
  std::vector<double> windows(n, options_.min_window);
  ARGMESH_ASSIGN_OR_RETURN(std::vector<int32_t> root, Climb(windows, stop));
  FirstStage stage;
  for (size_t v = 0; v < n; ++v) {
    if (root[v] == static_cast<int32_t>(v)) {
      stage.modes.push_back(Grow(root[v], windows));
    }
  }
  ARGMESH_ASSIGN_OR_RETURN(stage.label_of_sample, Climb(windows, stop));

  const SurfaceGraph& graph = input_.edge_graph;
  stage.link_weights.resize(graph.targets.size());
  for (int v = 0; v < graph.num_vertices(); ++v) {
    const auto row = static_cast<size_t>(v);
    for (auto link = static_cast<size_t>(graph.offsets[row]);
         link < static_cast<size_t>(graph.offsets[row + 1]); ++link) {
      const double distance =
          (range_.col(v) - range_.col(graph.targets[link])).norm();
      stage.link_weights[link] = std::exp(-2 * distance);
    }
  }
  return stage;
}

}  // namespace

absl::StatusOr<FirstStage> FindNormalCurvatureModes(
    const DecompositionInput& input, const NormalCurvatureOptions& options,
    const StopToken& stop) {
  return ModeSeeker(input, options).Find(stop);
}

}  // namespace argmesh
