#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/matching/coverage.h"
#include "core/matching/level_similarity.h"
#include "core/matching/match.h"
#include "core/matching/packed_graph.h"
#include "core/matching/spectral_matching.h"

namespace argmesh {
namespace {

// Two levels that meet, and what came of it.
struct Meeting {
  size_t query_level;
  size_t target_level;
  double score = 0;
};

// Level k with level k, the finest with the finest, uniform with uniform.
// Coarse to fine, then uniform.
std::vector<Meeting> PairLevels(const MatchableGraph::Impl& query,
                                const MatchableGraph::Impl& target) {
  std::vector<Meeting> meetings;
  const size_t n = std::min(query.levels.size(), target.levels.size());
  for (size_t l = 0; l + 1 < n; ++l) meetings.push_back({l, l});
  if (n > 0) {
    meetings.push_back({query.levels.size() - 1, target.levels.size() - 1});
  }
  if (query.uniform.num_nodes() > 0 && target.uniform.num_nodes() > 0) {
    meetings.push_back({query.levels.size(), target.levels.size()});
  }
  return meetings;
}

bool IsUniform(const Meeting& m, const MatchableGraph::Impl& query) {
  return m.query_level == query.levels.size();
}

// Half the components', half the uniform level's; one alone when there is no
// other.
double MeanScore(const std::vector<Meeting>& meetings,
                 const MatchableGraph::Impl& query) {
  if (meetings.empty()) return 0;
  const bool uniform = IsUniform(meetings.back(), query);
  const size_t components = meetings.size() - (uniform ? 1 : 0);
  if (components == 0) return meetings.back().score;
  double sum = 0;
  for (size_t i = 0; i < components; ++i) sum += meetings[i].score;
  const double mean = sum / static_cast<double>(components);
  return uniform ? (mean + meetings.back().score) / 2 : mean;
}

// The highest score; levels of one node only when there is no other, the
// finest components first among equals.
const Meeting* ChooseBest(const std::vector<Meeting>& meetings,
                          const MatchableGraph::Impl& query,
                          const MatchableGraph::Impl& target) {
  const auto is_trivial = [&](const Meeting& m) {
    return query.Level(m.query_level).num_nodes() < 2 ||
           target.Level(m.target_level).num_nodes() < 2;
  };
  const Meeting* best = nullptr;
  for (auto m = meetings.rbegin(); m != meetings.rend(); ++m) {
    const bool better =
        best == nullptr || (is_trivial(*best) && !is_trivial(*m)) ||
        (is_trivial(*best) == is_trivial(*m) &&
         (m->score > best->score ||
          (m->score == best->score && IsUniform(*best, query))));
    if (better) best = &*m;
  }
  return best;
}

void FillCorrespondence(const PackedLevel& query, const PackedLevel& target,
                        RowKind kind, MatchResult& result) {
  result.pairs = MatchSpectral(query, target, kind);
  result.query_coverage = QueryCoverage(query, result.pairs);
  result.target_coverage = TargetCoverage(target, result.pairs);
}

}  // namespace

MatchResult MatchGlobal(const MatchableGraph& query,
                        const MatchableGraph& target,
                        const MatchOptions& options) {
  const MatchableGraph::Impl& q = query.impl();
  const MatchableGraph::Impl& t = target.impl();
  const RowKind kind = options.attributes == AttributeSet::kTuple
                           ? RowKind::kTuple
                           : RowKind::kFull;
  MatchResult result;
  std::vector<Meeting> meetings = PairLevels(q, t);
  std::erase_if(meetings, [&](const Meeting& m) {
    return !options.Counts(q.names[m.query_level]);
  });
  for (Meeting& m : meetings) {
    m.score =
        ScoreLevels(q.Level(m.query_level), t.Level(m.target_level), kind);
    result.level_scores.push_back(
        {q.names[m.query_level], static_cast<float>(m.score)});
  }
  result.score = MeanScore(meetings, q);
  const Meeting* best = ChooseBest(meetings, q, t);
  if (best == nullptr) return result;
  result.best_level = q.names[best->query_level];
  result.best_query_level = static_cast<int32_t>(best->query_level);
  result.best_target_level = static_cast<int32_t>(best->target_level);
  if (options.correspondence) {
    FillCorrespondence(q.Level(best->query_level), t.Level(best->target_level),
                       kind, result);
  }
  return result;
}

}  // namespace argmesh
