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
  std::vector<float> profits = NodeSimilarities(rows, cols, kind);
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
    score +=
        static_cast<double>(profits[i * m + static_cast<size_t>(assigned[i])]);
  }
  return std::min(score, 1.0);
}

}  // namespace argmesh
