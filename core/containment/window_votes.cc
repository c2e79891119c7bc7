#include "core/containment/window_votes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "core/containment/descriptor_table.h"
#include "core/containment/query_weights.h"
#include "core/containment/window_codebook.h"

namespace argmesh {
namespace {

constexpr double kVoteSigma = 0.25;
constexpr size_t kExactShifts = 3;

using Tables = std::array<DescriptorTable, kNumTargetLevels>;

Tables MakeTables(const TargetWindows& target) {
  Tables tables;
  for (size_t b = 0; b < tables.size(); ++b) {
    tables[b] = DescriptorTable(target.levels[b].descriptors);
  }
  return tables;
}

double VotesAtShift(const QueryWindows& query, const VoteResult& votes,
                    int shift, bool flipped, const Tables& tables) {
  const float unit = DefaultWindowCodebook().unit;
  const auto falloff =
      static_cast<float>(-1 / (2 * kVoteSigma * kVoteSigma)) / (unit * unit);
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
  return sum;
}

}  // namespace

std::array<int, kNumShifts> ShiftsByVotes(const ShapeVotes& votes) {
  std::array<int, kNumShifts> order{};
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return votes.by_shift[static_cast<size_t>(a)] >
           votes.by_shift[static_cast<size_t>(b)];
  });
  return order;
}

ShapeVotes VoteExactly(const QueryWindows& query, const VoteResult& votes,
                       const ShapeVotes& indexed, bool flipped,
                       const TargetWindows& target) {
  ShapeVotes result;
  result.slot = indexed.slot;
  if (!(votes.total_weight > 0)) return result;
  const Tables tables = MakeTables(target);
  const std::array<int, kNumShifts> shifts = ShiftsByVotes(indexed);
  for (const int shift : std::span(shifts).first<kExactShifts>()) {
    const double score =
        VotesAtShift(query, votes, shift, flipped, tables) / votes.total_weight;
    result.by_shift[static_cast<size_t>(shift)] = static_cast<float>(score);
    result.score = std::max(result.score, score);
  }
  return result;
}

}  // namespace argmesh
