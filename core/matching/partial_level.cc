#include "core/matching/partial_level.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/matching/assignment.h"
#include "core/matching/coverage.h"
#include "core/matching/level_similarity.h"

namespace argmesh {
namespace {

constexpr double kScatterPenalty = 0.3;
constexpr float kMinDistance = 1e-4F;

std::vector<NodePair> FindNodes(const PackedLevel& query,
                                const PackedLevel& target) {
  std::vector<NodePair> pairs;
  if (CompareLevels(query, target, RowKind::kPartial) == 0) {
    for (int i = 0; i < query.num_nodes(); ++i) pairs.push_back({i, i, 1.0F});
    return pairs;
  }
  const std::vector<float> similarities =
      NodeSimilarities(query, target, RowKind::kPartial);
  const size_t m = target.area.size();
  std::vector<float> profits = similarities;
  for (size_t i = 0; i < profits.size(); ++i) {
    profits[i] *= query.weight[i / m];
  }
  const std::vector<int32_t> assigned =
      SolveAssignment(profits, query.num_nodes(), target.num_nodes());
  for (size_t i = 0; i < assigned.size(); ++i) {
    const float similarity =
        similarities[i * m + static_cast<size_t>(assigned[i])];
    if (similarity < kMinPartialSimilarity) continue;
    pairs.push_back({static_cast<int32_t>(i), assigned[i], similarity});
  }
  return pairs;
}

double MeanSimilarity(const PackedLevel& query,
                      const std::vector<NodePair>& pairs) {
  double sum = 0, weight = 0;
  for (const NodePair& pair : pairs) {
    const auto w =
        static_cast<double>(query.weight[static_cast<size_t>(pair.query_node)]);
    sum += w * static_cast<double>(pair.similarity);
    weight += w;
  }
  return weight > 0 ? sum / weight : 0;
}

// 1 when all distances between pairs changed by the same factor.
double DistanceConsistency(const PackedLevel& query, const PackedLevel& target,
                           const std::vector<NodePair>& pairs) {
  struct Change {
    float log_ratio;
    double weight;
  };
  std::vector<Change> changes;
  for (size_t a = 0; a < pairs.size(); ++a) {
    for (size_t b = a + 1; b < pairs.size(); ++b) {
      const auto qa = static_cast<size_t>(pairs[a].query_node);
      const auto qb = static_cast<size_t>(pairs[b].query_node);
      const float before = query.Distance(qa, qb);
      const float after =
          target.Distance(static_cast<size_t>(pairs[a].target_node),
                          static_cast<size_t>(pairs[b].target_node));
      changes.push_back({std::log(std::max(after, kMinDistance) /
                                  std::max(before, kMinDistance)),
                         static_cast<double>(query.weight[qa]) *
                             static_cast<double>(query.weight[qb])});
    }
  }
  if (changes.empty()) return 1;
  std::vector<float> ratios;
  ratios.reserve(changes.size());
  for (const Change& change : changes) ratios.push_back(change.log_ratio);
  const auto middle =
      ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  double sum = 0, weight = 0;
  for (const Change& change : changes) {
    sum += change.weight *
           static_cast<double>(std::exp(-std::abs(change.log_ratio - *middle)));
    weight += change.weight;
  }
  return weight > 0 ? sum / weight : 1;
}

}  // namespace

PartialLevelMatch MatchPartialLevel(const PackedLevel& query,
                                    const PackedLevel& target) {
  PartialLevelMatch match;
  match.pairs = FindNodes(query, target);
  match.query_coverage = QueryCoverage(query, match.pairs);
  const double consistency = DistanceConsistency(query, target, match.pairs);
  match.score = match.query_coverage * MeanSimilarity(query, match.pairs) *
                (1 - kScatterPenalty * (1 - consistency));
  return match;
}

}  // namespace argmesh
