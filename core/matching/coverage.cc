#include "core/matching/coverage.h"

#include <cstdint>
#include <span>
#include <vector>

namespace argmesh {
namespace {

double CoveredShare(const PackedLevel& level, std::span<const NodePair> pairs,
                    int32_t NodePair::*node) {
  std::vector<char> covered(level.area.size(), 0);
  for (const NodePair& pair : pairs) {
    covered[static_cast<size_t>(pair.*node)] = 1;
  }
  // In the order of the nodes, so that all of them sum to the total exactly.
  double sum = 0, total = 0;
  for (size_t i = 0; i < covered.size(); ++i) {
    const auto area = static_cast<double>(level.area[i]);
    total += area;
    if (covered[i] != 0) sum += area;
  }
  return total > 0 ? sum / total : 0;
}

}  // namespace

double QueryCoverage(const PackedLevel& query,
                     std::span<const NodePair> pairs) {
  return CoveredShare(query, pairs, &NodePair::query_node);
}

double TargetCoverage(const PackedLevel& target,
                      std::span<const NodePair> pairs) {
  return CoveredShare(target, pairs, &NodePair::target_node);
}

}  // namespace argmesh
