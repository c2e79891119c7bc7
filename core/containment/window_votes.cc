#include "core/containment/window_votes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/containment/descriptor_table.h"
#include "core/containment/query_weights.h"
#include "core/containment/window_codebook.h"

namespace argmesh {
namespace {

constexpr double kSigma = 0.25;

}  // namespace

ShapeVotes VoteExactly(const QueryWindows& query, const VoteResult& votes,
                       bool flipped, const TargetWindows& target) {
  ShapeVotes result;
  if (!(votes.total_weight > 0)) return result;
  const float unit = DefaultWindowCodebook().unit;
  const auto falloff =
      static_cast<float>(-1 / (2 * kSigma * kSigma)) / (unit * unit);
  std::array<DescriptorTable, kNumTargetLevels> tables;
  for (size_t b = 0; b < tables.size(); ++b) {
    tables[b] = DescriptorTable(target.levels[b].descriptors);
  }
  for (int shift = 0; shift < kNumShifts; ++shift) {
    double sum = 0;
    size_t i = 0;
    for (size_t l = 0; l < query.levels.size(); ++l) {
      const std::optional<size_t> met = MetLevel(l, shift);
      const std::vector<QueryWindow>& windows = query.levels[l].windows;
      if (!met || tables[*met].size() == 0) {
        i += windows.size();
        continue;
      }
      for (const QueryWindow& window : windows) {
        const float squared =
            tables[*met].NearestSquared(DescriptorOf(window, flipped));
        sum += votes.weights[i++] * std::exp(falloff * squared);
      }
    }
    const double score = sum / votes.total_weight;
    result.by_shift[static_cast<size_t>(shift)] = static_cast<float>(score);
    result.score = std::max(result.score, score);
  }
  return result;
}

}  // namespace argmesh
