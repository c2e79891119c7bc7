#include "server/engine/shape_ranker.h"

#include <algorithm>
#include <iterator>
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

MatchOptions ScanOptions(const RankQuery& query) {
  MatchOptions options;
  options.attributes = query.attributes;
  // The coverage of a global match is that of the correspondence at its best
  // level, so a bound on it needs all of both.
  const bool coverage =
      query.mode == MatchMode::kGlobal && query.min_query_coverage > 0;
  options.correspondence = coverage;
  options.all_level_scores = coverage;
  return options;
}

class ExactRanker : public ShapeRanker {
 public:
  explicit ExactRanker(ComputePool& pool) : pool_(pool) {}

  absl::StatusOr<Ranking> Rank(const GallerySnapshot& gallery,
                               const RankQuery& query,
                               const StopToken& stop) const override {
    std::vector<Ranking> parts(gallery.blocks.size());
    pool_.ParallelFor(WorkClass::kSearch,
                      static_cast<int64_t>(gallery.blocks.size()),
                      [&](int64_t b) {
                        const auto at = static_cast<size_t>(b);
                        RankBlock(*gallery.blocks[at], query, stop, parts[at]);
                      });
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    Ranking ranking;
    for (Ranking& part : parts) {
      std::move(part.shapes.begin(), part.shapes.end(),
                std::back_inserter(ranking.shapes));
      ranking.matched += part.matched;
    }
    KeepBest(ranking.shapes, static_cast<size_t>(query.limit));
    ranking.considered = ranking.matched;
    return ranking;
  }

 private:
  // Incomplete once `stop` says so, which Rank tells.
  static void RankBlock(const GalleryBlock& block, const RankQuery& query,
                        const StopToken& stop, Ranking& part) {
    const MatchOptions options = ScanOptions(query);
    for (const GalleryEntryPtr& entry : block) {
      if (entry->record.id == query.exclude_id) continue;
      if (!stop.Check().ok()) return;
      const MatchResult match =
          MatchGraphs(query.mode, query.graph, entry->graph, options);
      ++part.matched;
      if (match.score >= query.min_score &&
          match.query_coverage >= query.min_query_coverage) {
        part.shapes.push_back({entry, match.score});
      }
    }
    KeepBest(part.shapes, static_cast<size_t>(query.limit));
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

std::unique_ptr<ShapeRanker> MakeExactRanker(ComputePool& pool) {
  return std::make_unique<ExactRanker>(pool);
}

}  // namespace argmesh
