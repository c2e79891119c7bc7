#include "core/evaluation/segmentation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

// Areas of the segments of both labellings and of their intersections.
struct Overlaps {
  std::map<int32_t, double> first, second;
  std::map<std::pair<int32_t, int32_t>, double> both;
  double total = 0;
};

absl::StatusOr<Overlaps> Measure(std::span<const int32_t> a,
                                 std::span<const int32_t> b,
                                 std::span<const double> areas) {
  if (a.size() != areas.size() || b.size() != areas.size()) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%d and %d labels of %d areas", a.size(), b.size(), areas.size()));
  }
  Overlaps overlaps;
  for (size_t i = 0; i < areas.size(); ++i) {
    if (!(areas[i] >= 0) || !std::isfinite(areas[i])) {
      return absl::InvalidArgumentError(
          absl::StrFormat("element %d: area %g", i, areas[i]));
    }
    overlaps.first[a[i]] += areas[i];
    overlaps.second[b[i]] += areas[i];
    overlaps.both[{a[i], b[i]}] += areas[i];
    overlaps.total += areas[i];
  }
  if (!(overlaps.total > 0)) {
    return absl::InvalidArgumentError("the surface has no area");
  }
  return overlaps;
}

template <typename Areas>
double SumOfSquares(const Areas& areas, double total) {
  double sum = 0;
  for (const auto& [label, area] : areas) {
    sum += (area / total) * (area / total);
  }
  return sum;
}

}  // namespace

absl::StatusOr<double> RandIndexError(std::span<const int32_t> labels,
                                      std::span<const int32_t> reference,
                                      std::span<const double> areas) {
  ARGMESH_ASSIGN_OR_RETURN(const Overlaps overlaps,
                           Measure(labels, reference, areas));
  // P(together in the first) + P(together in the second) - 2 P(in both).
  const double error = SumOfSquares(overlaps.first, overlaps.total) +
                       SumOfSquares(overlaps.second, overlaps.total) -
                       2 * SumOfSquares(overlaps.both, overlaps.total);
  return std::max(0.0, error);
}

absl::StatusOr<double> Repeatability(std::span<const int32_t> labels,
                                     std::span<const int32_t> other,
                                     std::span<const double> areas,
                                     double min_overlap) {
  ARGMESH_ASSIGN_OR_RETURN(const Overlaps overlaps,
                           Measure(labels, other, areas));
  std::set<int32_t> repeated;
  for (const auto& [pair, area] : overlaps.both) {
    const double all =
        overlaps.first.at(pair.first) + overlaps.second.at(pair.second) - area;
    if (all > 0 && area >= min_overlap * all) repeated.insert(pair.first);
  }
  double sum = 0;
  for (const int32_t label : repeated) sum += overlaps.first.at(label);
  return std::min(1.0, sum / overlaps.total);
}

}  // namespace argmesh
