#include "core/matching/match_placed.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/matching/assignment.h"

namespace argmesh {
namespace {

constexpr float kMinShare = 0.1F;
constexpr double kAsGood = 0.9;

// The nodes of one level under every sample of an overlay; -1: none.
struct SampledLevel {
  int level = 0;
  int num_nodes = 0;
  std::vector<int16_t> nodes;
};

struct LevelPairs {
  int query_level = 0;
  int target_level = 0;
  double agreement = 0;  // mean share of the query's area, 0 .. 1
  std::vector<NodePair> pairs;
};

int16_t NodeAt(const std::vector<int16_t>& labels, int32_t face) {
  const auto at = static_cast<size_t>(face);
  return face < 0 || at >= labels.size() ? int16_t{-1} : labels[at];
}

// Coarse to fine.
std::vector<SampledLevel> SampleLevels(
    const LabelledGraph& side, std::span<const std::array<int32_t, 2>> overlaid,
    size_t which) {
  std::vector<SampledLevel> levels;
  for (int l = 0; l < static_cast<int>(side.graph.levels.size()); ++l) {
    const std::vector<int16_t> labels =
        LabelsAtLevel(side.graph, side.labels, l);
    SampledLevel& level = levels.emplace_back();
    level.level = l;
    level.num_nodes = side.graph.levels[static_cast<size_t>(l)].num_nodes();
    level.nodes.reserve(overlaid.size());
    for (const auto& sample : overlaid) {
      level.nodes.push_back(NodeAt(labels, sample[which]));
    }
  }
  return levels;
}

LevelPairs PairLevels(const SampledLevel& query, const SampledLevel& target) {
  const auto rows = static_cast<size_t>(query.num_nodes);
  const auto cols = static_cast<size_t>(target.num_nodes);
  std::vector<float> shared(rows * cols);
  std::vector<float> of_query(rows);
  std::vector<float> of_target(cols);
  float labelled = 0;
  for (size_t i = 0; i < query.nodes.size(); ++i) {
    if (query.nodes[i] < 0) continue;
    const auto q = static_cast<size_t>(query.nodes[i]);
    ++labelled;
    ++of_query[q];
    if (target.nodes[i] < 0) continue;
    const auto t = static_cast<size_t>(target.nodes[i]);
    ++of_target[t];
    ++shared[q * cols + t];
  }
  const auto share = [&](size_t q, size_t t) {
    const float both = shared[q * cols + t];
    return both > 0 ? both / (of_query[q] + of_target[t] - both) : 0.0F;
  };
  std::vector<float> profits(rows * cols);
  for (size_t q = 0; q < rows; ++q) {
    for (size_t t = 0; t < cols; ++t) {
      profits[q * cols + t] = of_query[q] * share(q, t);
    }
  }
  LevelPairs result{query.level, target.level, 0, {}};
  const std::vector<int32_t> assigned =
      SolveAssignment(profits, query.num_nodes, target.num_nodes);
  for (size_t q = 0; q < rows; ++q) {
    if (assigned[q] < 0) continue;
    const auto t = static_cast<size_t>(assigned[q]);
    if (share(q, t) < kMinShare) continue;
    result.agreement += profits[q * cols + t] / labelled;
    result.pairs.push_back({static_cast<int32_t>(q), assigned[q], share(q, t)});
  }
  return result;
}

}  // namespace

void MatchPlaced(const LabelledGraph& query, const LabelledGraph& target,
                 std::span<const std::array<int32_t, 2>> overlaid,
                 const MatchOptions& options, MatchResult& match) {
  const std::vector<std::string> names = LevelNames(query.graph);
  std::vector<SampledLevel> laid = SampleLevels(query, overlaid, 0);
  std::erase_if(laid, [&](const SampledLevel& level) {
    return !options.Counts(names[static_cast<size_t>(level.level)]);
  });
  const bool has_many = std::any_of(
      laid.begin(), laid.end(),
      [](const SampledLevel& level) { return level.num_nodes > 1; });
  const std::vector<SampledLevel> base = SampleLevels(target, overlaid, 1);
  std::vector<LevelPairs> candidates;
  double best = 0;
  for (const SampledLevel& level : laid) {
    if (has_many && level.num_nodes == 1) continue;
    for (const SampledLevel& other : base) {
      candidates.push_back(PairLevels(level, other));
      best = std::max(best, candidates.back().agreement);
    }
  }
  if (best <= 0) return;
  const auto chosen = std::find_if(
      candidates.rbegin(), candidates.rend(), [&](const LevelPairs& candidate) {
        return candidate.agreement >= kAsGood * best;
      });
  match.best_query_level = chosen->query_level;
  match.best_target_level = chosen->target_level;
  match.best_level = names[static_cast<size_t>(chosen->query_level)];
  match.pairs = std::move(chosen->pairs);
}

}  // namespace argmesh
