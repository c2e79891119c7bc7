// How sure a mean over queries is.
//
// Source   Efron, "Bootstrap Methods: Another Look at the Jackknife", Annals
//          of Statistics 7(1), 1979; percentile interval.
// Repeats  equal values, options and seed give equal intervals.
// Fails    kInvalidArgument  no value, or an option outside its range
// Cost     O(resamples * n). Thread-safe.
#ifndef ARGMESH_CORE_EVALUATION_BOOTSTRAP_H_
#define ARGMESH_CORE_EVALUATION_BOOTSTRAP_H_

#include <cstdint>
#include <span>

#include "absl/status/statusor.h"

namespace argmesh {

struct BootstrapOptions {
  int resamples = 2000;      // 10 .. 1,000,000
  double confidence = 0.95;  // > 0, < 1
  uint64_t seed = 1;
};

struct ConfidenceInterval {
  double mean = 0;
  double low = 0;
  double high = 0;
};

// For the difference of two systems pass the differences query by query.
absl::StatusOr<ConfidenceInterval> BootstrapMean(
    std::span<const double> values, const BootstrapOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_EVALUATION_BOOTSTRAP_H_
