#include "server/engine/search_reranking.h"

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/status_macros.h"
#include "core/matching/fused_score.h"
#include "core/matching/match.h"
#include "core/signature/rerank.h"
#include "core/signature/signature_similarity.h"

namespace argmesh {
namespace {

// Verified shapes that vouch for others, and what their word weighs beside the
// score.
constexpr size_t kVouching = 3;
constexpr double kVouchWeight = 0.2;

double PairScore(const GalleryEntry& a, const GalleryEntry& b) {
  MatchOptions options;
  options.correspondence = false;
  return FusedScore(MatchGlobal(a.graph, b.graph, options).score,
                    SignatureSimilarity(a.signature, b.signature));
}

// Row and column 0 are the query's.
Eigen::MatrixXd PairScores(ComputePool& pool, const StopToken& stop,
                           const std::vector<RankedShape>& shapes, int count) {
  Eigen::MatrixXd scores = Eigen::MatrixXd::Identity(count + 1, count + 1);
  pool.ParallelFor(WorkClass::kSearch, count, [&](int64_t i) {
    const RankedShape& shape = shapes[static_cast<size_t>(i)];
    scores(0, i + 1) = shape.score;
    for (int64_t j = i + 1; j < count && stop.Check().ok(); ++j) {
      scores(i + 1, j + 1) =
          PairScore(*shape.entry, *shapes[static_cast<size_t>(j)].entry);
    }
  });
  scores.triangularView<Eigen::StrictlyLower>() = scores.transpose();
  return scores;
}

// The first `count` by their keys, descending; equal ones stay as they were.
template <typename Keys, typename Shape>
void OrderByKeys(const Keys& keys, size_t count, std::vector<Shape>& shapes) {
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    using Index = decltype(keys.size());
    return keys[static_cast<Index>(a)] > keys[static_cast<Index>(b)];
  });
  std::vector<Shape> ordered;
  ordered.reserve(count);
  for (const size_t i : order) ordered.push_back(std::move(shapes[i]));
  std::move(ordered.begin(), ordered.end(), shapes.begin());
}

}  // namespace

absl::Status RerankShapes(ComputePool& pool, const StopToken& stop,
                          std::vector<RankedShape>& shapes) {
  const int count = std::min(kRerankedShapes, static_cast<int>(shapes.size()));
  if (count < 2) return absl::OkStatus();
  const Eigen::MatrixXd scores = PairScores(pool, stop, shapes, count);
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  ARGMESH_ASSIGN_OR_RETURN(const Eigen::VectorXd reranked,
                           RerankShortList(scores));
  OrderByKeys(reranked, static_cast<size_t>(count), shapes);
  return absl::OkStatus();
}

absl::Status RerankContaining(ComputePool& pool, const StopToken& stop,
                              std::vector<ContainingShape>& shapes) {
  std::vector<size_t> vouching;
  for (size_t i = 0; i < shapes.size() && vouching.size() < kVouching; ++i) {
    if (shapes[i].match.verified) vouching.push_back(i);
  }
  if (vouching.empty()) return absl::OkStatus();
  std::vector<double> keys(shapes.size());
  pool.ParallelFor(
      WorkClass::kSearch, static_cast<int64_t>(shapes.size()), [&](int64_t i) {
        const auto at = static_cast<size_t>(i);
        double word = 0;
        for (const size_t v : vouching) {
          if (!stop.Check().ok()) return;
          const double alike =
              v == at ? 1 : PairScore(*shapes[v].entry, *shapes[at].entry);
          word = std::max(word, alike);
        }
        keys[at] = shapes[at].score + kVouchWeight * word;
      });
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  OrderByKeys(keys, shapes.size(), shapes);
  return absl::OkStatus();
}

}  // namespace argmesh
