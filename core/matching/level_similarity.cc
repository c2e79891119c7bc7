#include "core/matching/level_similarity.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/matching/assignment.h"

namespace argmesh {
namespace {

template <size_t kWidth>
std::vector<float> Similarities(const std::vector<float>& a,
                                const std::vector<float>& b) {
  using Row = Eigen::Map<const Eigen::Array<float, kWidth, 1>>;
  std::vector<float> similarities;
  similarities.reserve(a.size() / kWidth * (b.size() / kWidth));
  for (size_t i = 0; i < a.size(); i += kWidth) {
    const Row x(a.data() + i);
    for (size_t j = 0; j < b.size(); j += kWidth) {
      const float distance = (x - Row(b.data() + j)).abs().sum();
      similarities.push_back(std::exp(distance * (-1 / kSimilarityScale)));
    }
  }
  return similarities;
}

// How well the distances from matched pair i to the other matched pairs agree,
// weighted like the pairs themselves: 0 .. 1, 1 for a pair alone.
double EdgeConsistency(const PackedLevel& rows, const PackedLevel& cols,
                       const std::vector<int32_t>& assigned, size_t i) {
  double agreement = 0;
  double total = 0;
  const auto x = static_cast<size_t>(assigned[i]);
  for (size_t j = 0; j < assigned.size(); ++j) {
    if (j == i) continue;
    const auto y = static_cast<size_t>(assigned[j]);
    const float weight = rows.weight[j] + cols.weight[y];
    const float difference =
        std::abs(rows.Distance(i, j) - cols.Distance(x, y));
    agreement +=
        static_cast<double>(weight * std::exp(difference * (-1 / kEdgeScale)));
    total += static_cast<double>(weight);
  }
  return total > 0 ? agreement / total : 1;
}

// The best one-to-one assignment, pairs weighted with the mean of both nodes'
// weights.
double ScoreAssignment(const PackedLevel& rows, const PackedLevel& cols,
                       std::vector<float> profits) {
  const size_t m = cols.weight.size();
  for (size_t i = 0; i < rows.weight.size(); ++i) {
    for (size_t j = 0; j < m; ++j) {
      profits[i * m + j] *= (rows.weight[i] + cols.weight[j]) / 2;
    }
  }
  const std::vector<int32_t> assigned =
      SolveAssignment(profits, rows.num_nodes(), cols.num_nodes());
  double score = 0;
  for (size_t i = 0; i < assigned.size(); ++i) {
    const double profit =
        static_cast<double>(profits[i * m + static_cast<size_t>(assigned[i])]);
    const double edges = EdgeConsistency(rows, cols, assigned, i);
    score += profit * (1 - kEdgeShare + kEdgeShare * edges);
  }
  return score;
}

// The mean of the highest similarity of each row and of each column.
double ScoreNearest(const PackedLevel& rows, const PackedLevel& cols,
                    const std::vector<float>& similarities) {
  const size_t m = cols.weight.size();
  std::vector<float> best_of_column(m, 0.0F);
  double score = 0;
  for (size_t i = 0; i < rows.weight.size(); ++i) {
    float best = 0;
    for (size_t j = 0; j < m; ++j) {
      const float similarity = similarities[i * m + j];
      best = std::max(best, similarity);
      best_of_column[j] = std::max(best_of_column[j], similarity);
    }
    score += static_cast<double>(best * rows.weight[i]);
  }
  for (size_t j = 0; j < m; ++j) {
    score += static_cast<double>(best_of_column[j] * cols.weight[j]);
  }
  return score / 2;
}

}  // namespace

std::vector<float> NodeSimilarities(const PackedLevel& a, const PackedLevel& b,
                                    RowKind kind) {
  switch (kind) {
    case RowKind::kFull:
      return Similarities<kFullWidth>(a.full, b.full);
    case RowKind::kTuple:
      return Similarities<kTupleWidth>(a.tuple, b.tuple);
    case RowKind::kPartial:
      return Similarities<kPartialWidth>(a.partial, b.partial);
  }
  return {};
}

double ScoreLevels(const PackedLevel& a, const PackedLevel& b, RowKind kind) {
  const int order = CompareLevels(a, b, kind);
  // No assignment of a level to itself beats the identity.
  if (order == 0) return 1;
  const PackedLevel& rows = order < 0 ? a : b;
  const PackedLevel& cols = order < 0 ? b : a;
  const std::vector<float> similarities = NodeSimilarities(rows, cols, kind);
  const double score = (ScoreAssignment(rows, cols, similarities) +
                        ScoreNearest(rows, cols, similarities)) /
                       2;
  return std::min(score, 1.0);
}

}  // namespace argmesh
