#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/matching/coverage.h"
#include "core/matching/match.h"
#include "core/matching/packed_graph.h"
#include "core/matching/partial_level.h"

namespace argmesh {
namespace {

// The best match of one level of the query.
struct LevelMatch {
  bool tried = false;
  size_t target_level = 0;
  PartialLevelMatch match;
};

// A single node resembles some node of every shape: such a level counts only
// when the query has no other.
bool HasManyNodes(const MatchableGraph::Impl& query,
                  const MatchOptions& options) {
  for (size_t level = 0; level <= query.levels.size(); ++level) {
    if (query.Level(level).num_nodes() > 1 &&
        options.Counts(query.names[level])) {
      return true;
    }
  }
  return false;
}

void TryLevels(const PackedLevel& query, const MatchableGraph::Impl& target,
               size_t target_level, LevelMatch& best) {
  const PackedLevel& level = target.Level(target_level);
  if (query.num_nodes() == 0 || query.num_nodes() > level.num_nodes()) return;
  PartialLevelMatch match = MatchPartialLevel(query, level);
  if (best.tried && match.score <= best.match.score) return;
  best = {true, target_level, std::move(match)};
}

LevelMatch MatchQueryLevel(const MatchableGraph::Impl& query,
                           const MatchableGraph::Impl& target, size_t level,
                           const MatchOptions& options) {
  LevelMatch best;
  const PackedLevel& nodes = query.Level(level);
  if (!options.Counts(query.names[level])) return best;
  if (nodes.num_nodes() == 1 && HasManyNodes(query, options)) return best;
  if (level == query.levels.size()) {
    TryLevels(nodes, target, target.levels.size(), best);
    return best;
  }
  for (size_t l = target.levels.size(); l-- > 0;) {
    TryLevels(nodes, target, l, best);
  }
  return best;
}

}  // namespace

MatchResult MatchPartial(const MatchableGraph& query,
                         const MatchableGraph& target,
                         const MatchOptions& options) {
  const MatchableGraph::Impl& q = query.impl();
  const MatchableGraph::Impl& t = target.impl();
  MatchResult result;
  std::vector<LevelMatch> matches;
  for (size_t level = 0; level <= q.levels.size(); ++level) {
    matches.push_back(MatchQueryLevel(q, t, level, options));
    if (!matches.back().tried) continue;
    result.level_scores.push_back(
        {q.names[level], static_cast<float>(matches.back().match.score)});
  }
  // Finest components first, then coarser, uniform last.
  size_t best = matches.size();
  const auto consider = [&matches, &best](size_t level) {
    if (!matches[level].tried) return;
    if (best == matches.size() ||
        matches[level].match.score > matches[best].match.score) {
      best = level;
    }
  };
  for (size_t level = q.levels.size(); level-- > 0;) consider(level);
  consider(q.levels.size());
  if (best == matches.size()) return result;
  const LevelMatch& chosen = matches[best];
  result.score = std::min(chosen.match.score, 1.0);
  result.best_level = q.names[best];
  result.best_query_level = static_cast<int32_t>(best);
  result.best_target_level = static_cast<int32_t>(chosen.target_level);
  result.query_coverage = chosen.match.query_coverage;
  result.target_coverage =
      TargetCoverage(t.Level(chosen.target_level), chosen.match.pairs);
  if (options.correspondence) result.pairs = chosen.match.pairs;
  return result;
}

}  // namespace argmesh
