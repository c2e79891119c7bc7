#include "core/containment/query_windows.h"

#include <algorithm>
#include <cstddef>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/containment/window_codebook.h"
#include "core/containment/window_extraction.h"

namespace argmesh {
namespace {

constexpr int kMaxAccepted = 200;
constexpr int kNumSamples = 16384;

absl::Status CheckOptions(const QueryWindowsOptions& options) {
  if (options.level_cap < 4 || options.level_cap > kMaxAccepted) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "level_cap is %d, not 4 .. %d", options.level_cap, kMaxAccepted));
  }
  if (options.num_points < 512 || options.num_points > kNumSamples) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "num_points is %d, not 512 .. %d", options.num_points, kNumSamples));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<QueryWindows> ExtractQueryWindows(
    const TriangleMesh& repaired, const QueryWindowsOptions& options,
    const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(CheckOptions(options));
  ExtractionPlan plan;
  plan.num_samples = kNumSamples;
  plan.first_radius = kFirstQueryRadius;
  plan.num_levels = kNumQueryLevels;
  plan.accept_cap = kMaxAccepted;
  plan.describe_cap = options.level_cap;
  plan.boundary_margin = 0.8;
  plan.orient_open = false;  // both ways are tried
  plan.seed = options.seed ^ 0x9e3779b97f4a7c15;
  ARGMESH_ASSIGN_OR_RETURN(RawWindowSet raw,
                           ExtractRawWindows(repaired, plan, stop));
  const WindowCodebook& codebook = DefaultWindowCodebook();
  QueryWindows windows;
  windows.frame = raw.frame;
  for (size_t l = 0; l < windows.levels.size(); ++l) {
    windows.levels[l].accepted = raw.levels[l].accepted;
    for (const DescribedWindow& window : raw.levels[l].windows) {
      windows.levels[l].windows.push_back(
          {window.position, window.axis, codebook.Project(window.raw),
           codebook.Project(FlipDescriptor(window.raw))});
    }
  }
  const size_t points = std::min(raw.samples.positions.size(),
                                 static_cast<size_t>(options.num_points));
  raw.samples.positions.resize(points);
  raw.samples.normals.resize(points);
  windows.points = std::move(raw.samples.positions);
  windows.normals = std::move(raw.samples.normals);
  return windows;
}

}  // namespace argmesh
