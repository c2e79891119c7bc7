#include "core/matching/spectral_matching.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/matching/level_similarity.h"

namespace argmesh {
namespace {

constexpr size_t kCandidatesPerNode = 4;
constexpr float kDistanceScale = 0.15F;
constexpr int kPowerIterations = 20;

struct Candidate {
  size_t row;
  size_t col;
  float similarity;
};

std::vector<Candidate> ChooseCandidates(const PackedLevel& rows,
                                        const PackedLevel& cols, RowKind kind) {
  const std::vector<float> similarities = NodeSimilarities(rows, cols, kind);
  const size_t m = cols.area.size();
  const size_t keep = std::min(m, kCandidatesPerNode);
  std::vector<Candidate> candidates;
  std::vector<size_t> order(m);
  for (size_t i = 0; i < rows.area.size(); ++i) {
    const float* row = similarities.data() + i * m;
    std::iota(order.begin(), order.end(), size_t{0});
    std::partial_sort(order.begin(),
                      order.begin() + static_cast<std::ptrdiff_t>(keep),
                      order.end(), [row](size_t x, size_t y) {
                        return row[x] != row[y] ? row[x] > row[y] : x < y;
                      });
    for (size_t k = 0; k < keep; ++k) {
      candidates.push_back({i, order[k], row[order[k]]});
    }
  }
  return candidates;
}

Eigen::MatrixXf Affinities(const PackedLevel& rows, const PackedLevel& cols,
                           const std::vector<Candidate>& candidates) {
  const auto n = static_cast<Eigen::Index>(candidates.size());
  Eigen::MatrixXf affinity(n, n);
  for (Eigen::Index a = 0; a < n; ++a) {
    const Candidate& x = candidates[static_cast<size_t>(a)];
    affinity(a, a) = x.similarity;
    for (Eigen::Index b = a + 1; b < n; ++b) {
      const Candidate& y = candidates[static_cast<size_t>(b)];
      float support = 0;  // of pairs that exclude each other
      if (x.row != y.row && x.col != y.col) {
        const float difference =
            std::abs(rows.Distance(x.row, y.row) - cols.Distance(x.col, y.col));
        support = std::exp(-difference / kDistanceScale) *
                  std::sqrt(x.similarity * y.similarity);
      }
      affinity(a, b) = support;
      affinity(b, a) = support;
    }
  }
  return affinity;
}

Eigen::VectorXf PrincipalVector(const Eigen::MatrixXf& affinity) {
  const Eigen::Index n = affinity.rows();
  Eigen::VectorXf x = Eigen::VectorXf::Ones(n) / std::sqrt(float(n));
  for (int iteration = 0; iteration < kPowerIterations; ++iteration) {
    const Eigen::VectorXf next = affinity * x;
    const float norm = next.norm();
    if (!(norm > 0)) break;
    x = next / norm;
  }
  return x;
}

// Strongest first, each row and column once.
std::vector<Candidate> PickOneToOne(const std::vector<Candidate>& candidates,
                                    const Eigen::VectorXf& strength,
                                    const PackedLevel& rows,
                                    const PackedLevel& cols) {
  std::vector<size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto strength_of = [&strength](size_t i) {
    return strength[static_cast<Eigen::Index>(i)];
  };
  std::sort(order.begin(), order.end(), [&strength_of](size_t x, size_t y) {
    const float a = strength_of(x), b = strength_of(y);
    return a != b ? a > b : x < y;
  });
  std::vector<char> row_used(rows.area.size(), 0);
  std::vector<char> col_used(cols.area.size(), 0);
  std::vector<Candidate> picked;
  for (const size_t i : order) {
    const Candidate& c = candidates[i];
    if (row_used[c.row] != 0 || col_used[c.col] != 0) continue;
    if (!(strength_of(i) > 0)) break;
    row_used[c.row] = 1;
    col_used[c.col] = 1;
    picked.push_back(c);
  }
  return picked;
}

}  // namespace

std::vector<NodePair> MatchSpectral(const PackedLevel& query,
                                    const PackedLevel& target, RowKind kind) {
  std::vector<NodePair> pairs;
  const int order = CompareLevels(query, target, kind);
  if (order == 0) {
    for (int i = 0; i < query.num_nodes(); ++i) pairs.push_back({i, i, 1.0F});
    return pairs;
  }
  const PackedLevel& rows = order < 0 ? query : target;
  const PackedLevel& cols = order < 0 ? target : query;
  const std::vector<Candidate> candidates = ChooseCandidates(rows, cols, kind);
  const Eigen::VectorXf strength =
      PrincipalVector(Affinities(rows, cols, candidates));
  for (const Candidate& c : PickOneToOne(candidates, strength, rows, cols)) {
    const auto row = static_cast<int32_t>(c.row);
    const auto col = static_cast<int32_t>(c.col);
    pairs.push_back(order < 0 ? NodePair{row, col, c.similarity}
                              : NodePair{col, row, c.similarity});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const NodePair& x, const NodePair& y) {
              return x.query_node < y.query_node;
            });
  return pairs;
}

}  // namespace argmesh
