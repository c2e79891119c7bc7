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

double PairScore(const GalleryEntry& a, const GalleryEntry& b) {
  const MatchOptions options = {.correspondence = false};
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

}  // namespace

absl::Status RerankShapes(ComputePool& pool, const StopToken& stop,
                          std::vector<RankedShape>& shapes) {
  const int count = std::min(kRerankedShapes, static_cast<int>(shapes.size()));
  if (count < 2) return absl::OkStatus();
  const Eigen::MatrixXd scores = PairScores(pool, stop, shapes, count);
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  ARGMESH_ASSIGN_OR_RETURN(const Eigen::VectorXd reranked,
                           RerankShortList(scores));
  std::vector<int> order(static_cast<size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return reranked[a] > reranked[b]; });
  std::vector<RankedShape> head;
  head.reserve(order.size());
  for (const int i : order) {
    head.push_back(std::move(shapes[static_cast<size_t>(i)]));
  }
  std::move(head.begin(), head.end(), shapes.begin());
  return absl::OkStatus();
}

}  // namespace argmesh
