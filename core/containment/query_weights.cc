#include "core/containment/query_weights.h"

#include <algorithm>
#include <cmath>

namespace argmesh {
namespace {

constexpr double kRadiusPower = 1.5;
// log2 of the ratio of the first radii, in levels.
constexpr int kFirstLevelGap = 2;

}  // namespace

std::vector<float> WindowWeights(const QueryWindows& query) {
  std::vector<float> weights;
  for (size_t l = 0; l < query.levels.size(); ++l) {
    const QueryLevel& level = query.levels[l];
    if (level.windows.empty()) continue;
    const double weight = std::exp2(kRadiusPower * static_cast<double>(l) / 2) *
                          level.accepted /
                          static_cast<double>(level.windows.size());
    weights.insert(weights.end(), level.windows.size(),
                   static_cast<float>(weight));
  }
  return weights;
}

std::optional<size_t> MetLevel(size_t level, int shift) {
  const int met =
      static_cast<int>(level) + kFirstLevelGap + kFirstShift + shift;
  if (met < 0 || met >= kNumTargetLevels) return std::nullopt;
  return static_cast<size_t>(met);
}

float ShiftScale(int shift) {
  return std::exp2(static_cast<float>(kFirstShift + shift) / 2);
}

const WindowDescriptor& DescriptorOf(const QueryWindow& window, bool flipped) {
  return flipped ? window.flipped : window.descriptor;
}

}  // namespace argmesh
