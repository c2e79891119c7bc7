// A histogram that shares each sample between the two nearest bins, so that
// small changes of a value never jump.
#ifndef ARGMESH_CORE_GRAPH_SOFT_HISTOGRAM_H_
#define ARGMESH_CORE_GRAPH_SOFT_HISTOGRAM_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace argmesh {

template <size_t kBins>
class SoftHistogram {
 public:
  // `value` in units of the whole range, clamped to 0 .. 1; `weight` >= 0.
  void Add(double value, double weight) {
    const double u =
        std::clamp(value, 0.0, 1.0) * static_cast<double>(kBins) - 0.5;
    const double low = std::floor(u);
    const double share = u - low;
    const int bin = static_cast<int>(low);
    bins_[Clamp(bin)] += weight * (1 - share);
    bins_[Clamp(bin + 1)] += weight * share;
  }

  // The bins divided by their sum; equal bins when nothing was added.
  std::array<float, kBins> Normalized() const {
    double sum = 0;
    for (const double bin : bins_) sum += bin;
    std::array<float, kBins> shares{};
    for (size_t i = 0; i < kBins; ++i) {
      shares[i] = static_cast<float>(
          sum > 0 ? bins_[i] / sum : 1.0 / static_cast<double>(kBins));
    }
    return shares;
  }

 private:
  static size_t Clamp(int bin) {
    return static_cast<size_t>(std::clamp(bin, 0, static_cast<int>(kBins) - 1));
  }

  std::array<double, kBins> bins_{};
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_GRAPH_SOFT_HISTOGRAM_H_
