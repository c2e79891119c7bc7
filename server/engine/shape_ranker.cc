#include "server/engine/shape_ranker.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "core/base/status_macros.h"

namespace argmesh {
namespace {

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

class ExactRanker : public ShapeRanker {
 public:
  explicit ExactRanker(ComputePool& pool) : pool_(pool) {}

  absl::StatusOr<Ranking> Rank(const GallerySnapshot& gallery,
                               const RankQuery& query,
                               const StopToken& stop) const override {
    const size_t limit = static_cast<size_t>(query.limit);
    MatchOptions options;
    options.attributes = query.attributes;
    options.all_level_scores = false;
    // The coverage of a global match comes with its correspondence.
    options.correspondence =
        query.mode == MatchMode::kGlobal && query.min_query_coverage > 0;
    std::vector<std::vector<RankedShape>> best(gallery.blocks.size());
    std::atomic<int64_t> matched{0};
    std::atomic<bool> stopped{false};
    pool_.ParallelFor(
        WorkClass::kSearch, static_cast<int64_t>(gallery.blocks.size()),
        [&](int64_t b) {
          const auto at = static_cast<size_t>(b);
          for (const GalleryEntryPtr& entry : *gallery.blocks[at]) {
            if (entry->record.id == query.exclude_id) continue;
            if (stopped || !stop.Check().ok()) {
              stopped = true;
              return;
            }
            const MatchResult match =
                MatchGraphs(query.mode, query.graph, entry->graph, options);
            ++matched;
            if (match.score >= query.min_score &&
                match.query_coverage >= query.min_query_coverage) {
              best[at].push_back({entry, match.score});
            }
          }
          KeepBest(best[at], limit);
        });
    if (stopped) ARGMESH_RETURN_IF_ERROR(stop.Check());
    Ranking ranking;
    for (std::vector<RankedShape>& shapes : best) {
      std::move(shapes.begin(), shapes.end(),
                std::back_inserter(ranking.shapes));
    }
    KeepBest(ranking.shapes, limit);
    ranking.considered = matched;
    ranking.matched = matched;
    return ranking;
  }

 private:
  ComputePool& pool_;
};

}  // namespace

MatchResult MatchGraphs(MatchMode mode, const MatchableGraph& query,
                        const MatchableGraph& target,
                        const MatchOptions& options) {
  return mode == MatchMode::kGlobal ? MatchGlobal(query, target, options)
                                    : MatchPartial(query, target, options);
}

std::unique_ptr<ShapeRanker> MakeExactRanker(ComputePool& pool) {
  return std::make_unique<ExactRanker>(pool);
}

}  // namespace argmesh
