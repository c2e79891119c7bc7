#include "core/containment/target_windows.h"

#include <cstddef>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/containment/window_codebook.h"
#include "core/containment/window_extraction.h"

namespace argmesh {
namespace {

absl::Status CheckOptions(const TargetWindowsOptions& options) {
  if (options.level_cap < 10 || options.level_cap > kMaxLevelWindows) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "level_cap is %d, not 10 .. %d", options.level_cap, kMaxLevelWindows));
  }
  if (options.num_points < 512 || options.num_points > kMaxTargetPoints) {
    return absl::InvalidArgumentError(
        absl::StrFormat("num_points is %d, not 512 .. %d", options.num_points,
                        kMaxTargetPoints));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<TargetWindows> ExtractTargetWindows(
    const TriangleMesh& repaired, const TargetWindowsOptions& options,
    const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(CheckOptions(options));
  ARGMESH_ASSIGN_OR_RETURN(
      const RawWindowSet raw,
      ExtractRawWindows(repaired, TargetPlan(options.level_cap, options.seed),
                        stop));
  const WindowCodebook& codebook = DefaultWindowCodebook();
  TargetWindows windows;
  windows.frame = raw.frame;
  for (size_t l = 0; l < windows.levels.size(); ++l) {
    for (const DescribedWindow& window : raw.levels[l].windows) {
      windows.levels[l].frames.push_back(
          PackPoint(window.position, window.axis));
      windows.levels[l].descriptors.push_back(codebook.Project(window.raw));
    }
  }
  const size_t points = std::min(raw.samples.positions.size(),
                                 static_cast<size_t>(options.num_points));
  windows.points.reserve(points);
  for (size_t i = 0; i < points; ++i) {
    windows.points.push_back(
        PackPoint(raw.samples.positions[i], raw.samples.normals[i]));
  }
  return windows;
}

}  // namespace argmesh
