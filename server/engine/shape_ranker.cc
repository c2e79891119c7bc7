#include "server/engine/shape_ranker.h"

#include <algorithm>
#include <utility>

#include "core/base/status_macros.h"
#include "core/matching/fused_score.h"
#include "core/signature/signature_similarity.h"

namespace argmesh {
namespace {

// Graphs that are matched by default: .1 s of one core.
constexpr int kDefaultCandidates = 1000;

bool RanksBefore(const RankedShape& a, const RankedShape& b) {
  if (a.score != b.score) return a.score > b.score;
  return a.entry->record.id < b.entry->record.id;
}

// The best `limit` of both, in order.
void KeepBest(std::vector<RankedShape>& shapes, size_t limit) {
  const size_t kept = std::min(limit, shapes.size());
  std::partial_sort(shapes.begin(),
                    shapes.begin() + static_cast<std::ptrdiff_t>(kept),
                    shapes.end(), RanksBefore);
  shapes.resize(kept);
}

MatchOptions ScanOptions(const RankQuery& query) {
  MatchOptions options = query.match;
  // The coverage of a global match is that of the correspondence at its best
  // level, so a bound on it needs both.
  options.correspondence =
      query.mode == MatchMode::kGlobal && query.min_query_coverage > 0;
  return options;
}

// The entries a query may find, in the order of their slots.
std::vector<RankedShape> ListShapes(const GallerySnapshot& gallery,
                                    const SlotSelection& selection) {
  std::vector<RankedShape> shapes;
  shapes.reserve(static_cast<size_t>(selection.count));
  for (size_t slot = 0; slot < selection.slots.size(); ++slot) {
    if (!selection.slots[slot]) continue;
    shapes.push_back({.entry = gallery.entry(static_cast<int64_t>(slot))});
  }
  return shapes;
}

class TwoStageRanker : public ShapeRanker {
 public:
  explicit TwoStageRanker(ComputePool& pool) : pool_(pool) {}

  absl::StatusOr<Ranking> Rank(const GallerySnapshot& gallery,
                               const RankQuery& query,
                               const StopToken& stop) const override {
    Ranking ranking;
    ranking.shapes = ListShapes(gallery, query.slots);
    ranking.considered = static_cast<int64_t>(ranking.shapes.size());
    if (query.signature != nullptr) {
      ForEach(ranking.shapes, stop, [&](RankedShape& shape) {
        shape.signature =
            SignatureSimilarity(*query.signature, shape.entry->signature);
        shape.score = shape.signature;
      });
      ARGMESH_RETURN_IF_ERROR(stop.Check());
      KeepCandidates(query, ranking);
    }
    ranking.matched = static_cast<int64_t>(ranking.shapes.size());
    MatchAll(query, stop, ranking.shapes);
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    std::erase_if(ranking.shapes, [&](const RankedShape& shape) {
      return shape.score < query.min_score;
    });
    KeepBest(ranking.shapes, static_cast<size_t>(query.limit));
    return ranking;
  }

 private:
  // Stops early once `stop` says so, which the caller checks.
  template <typename Body>
  void ForEach(std::vector<RankedShape>& shapes, const StopToken& stop,
               const Body& body) const {
    const size_t count =
        (shapes.size() + kGalleryBlockSize - 1) / kGalleryBlockSize;
    pool_.ParallelFor(
        WorkClass::kSearch, static_cast<int64_t>(count), [&](int64_t b) {
          const size_t begin = static_cast<size_t>(b) * kGalleryBlockSize;
          const size_t end = std::min(begin + kGalleryBlockSize, shapes.size());
          for (size_t i = begin; i < end; ++i) {
            if (!stop.Check().ok()) return;
            body(shapes[i]);
          }
        });
  }

  static void KeepCandidates(const RankQuery& query, Ranking& ranking) {
    const int wanted =
        query.candidates > 0 ? query.candidates : kDefaultCandidates;
    const auto candidates = static_cast<size_t>(std::max(wanted, query.limit));
    if (query.exact || ranking.shapes.size() <= candidates) return;
    KeepBest(ranking.shapes, candidates);
    for (size_t i = 0; i < ranking.shapes.size(); ++i) {
      ranking.shapes[i].candidate_rank = static_cast<int32_t>(i) + 1;
    }
    ranking.exhaustive = false;
  }

  // A shape that covers too little of the query scores below everything.
  void MatchAll(const RankQuery& query, const StopToken& stop,
                std::vector<RankedShape>& shapes) const {
    const MatchOptions options = ScanOptions(query);
    ForEach(shapes, stop, [&](RankedShape& shape) {
      const MatchResult match =
          MatchGraphs(query.mode, query.graph, shape.entry->graph, options);
      shape.score = query.signature == nullptr
                        ? match.score
                        : FusedScore(match.score, shape.signature);
      if (match.query_coverage < query.min_query_coverage) shape.score = -1;
    });
  }

  ComputePool& pool_;
};

}  // namespace

MatchResult MatchGraphs(MatchMode mode, const MatchableGraph& query,
                        const MatchableGraph& target,
                        const MatchOptions& options) {
  return mode == MatchMode::kGlobal ? MatchGlobal(query, target, options)
                                    : MatchPartial(query, target, options);
}

std::unique_ptr<ShapeRanker> MakeTwoStageRanker(ComputePool& pool) {
  return std::make_unique<TwoStageRanker>(pool);
}

}  // namespace argmesh
