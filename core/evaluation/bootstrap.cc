#include "core/evaluation/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/random.h"

namespace argmesh {

absl::StatusOr<ConfidenceInterval> BootstrapMean(
    std::span<const double> values, const BootstrapOptions& options) {
  if (values.empty()) {
    return absl::InvalidArgumentError("no values to take the mean of");
  }
  if (options.resamples < 10 || options.resamples > 1000000 ||
      !(options.confidence > 0 && options.confidence < 1)) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%d resamples, confidence %g", options.resamples, options.confidence));
  }
  const auto n = static_cast<double>(values.size());
  ConfidenceInterval interval;
  interval.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  Random random(options.seed);
  std::vector<double> means;
  means.reserve(static_cast<size_t>(options.resamples));
  for (int r = 0; r < options.resamples; ++r) {
    double sum = 0;
    for (size_t i = 0; i < values.size(); ++i) {
      sum += values[random.Below(values.size())];
    }
    means.push_back(sum / n);
  }
  std::sort(means.begin(), means.end());
  const double last = static_cast<double>(means.size() - 1);
  const auto quantile = [&means, last](double share) {
    return means[static_cast<size_t>(std::lround(share * last))];
  };
  interval.low = quantile((1 - options.confidence) / 2);
  interval.high = quantile((1 + options.confidence) / 2);
  return interval;
}

}  // namespace argmesh
