#include "server/engine/containment_ranker.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <utility>

#include "core/base/status_macros.h"
#include "core/base/stopwatch.h"
#include "core/containment/containment_ranking.h"
#include "core/containment/window_codec.h"
#include "core/containment/window_index.h"
#include "core/containment/window_words.h"

namespace argmesh {
namespace {

constexpr double kMaxContainment = 3;
constexpr double kGraphWeight = 0.15;
constexpr double kMaxScore = kMaxContainment + kGraphWeight;
constexpr int kExactLimit = 150;

// Reads candidates' windows; safe to call from any thread.
class WindowLoader {
 public:
  WindowLoader(const Catalog& catalog, const GallerySnapshot& gallery)
      : catalog_(catalog), gallery_(gallery) {}

  // Null for a shape that went since the snapshot and for one that cannot be
  // read.
  absl::StatusOr<std::shared_ptr<const TargetWindows>> Load(int64_t slot) {
    const std::string& id = gallery_.entry(slot)->record.id;
    const absl::StatusOr<std::string> bytes =
        catalog_.ReadWindows(gallery_.collection_uid, id);
    if (absl::IsNotFound(bytes.status())) return nullptr;
    if (bytes.ok()) {
      absl::StatusOr<TargetWindows> windows = ParseTargetWindows(*bytes);
      if (windows.ok()) {
        return std::make_shared<const TargetWindows>(*std::move(windows));
      }
    } else if (!absl::IsDataLoss(bytes.status())) {
      return bytes.status();
    }
    ++damaged_;
    return nullptr;
  }

  int64_t damaged() const { return damaged_; }

 private:
  const Catalog& catalog_;
  const GallerySnapshot& gallery_;
  std::atomic<int64_t> damaged_{0};
};

RankContainmentOptions OptionsOf(const ContainmentQuery& query) {
  const int all = static_cast<int>(std::max<int64_t>(query.slots.count, 1));
  RankContainmentOptions options;
  options.slots = &query.slots.slots;
  options.exact_limit = query.candidates > 0 ? query.candidates : kExactLimit;
  options.exact_limit =
      std::clamp(options.exact_limit, std::min(query.limit, all), all);
  options.verify_limit = std::max(options.verify_limit, query.candidates);
  if (query.exact) {
    options.exact_limit = all;
    options.verify_limit = all;
  }
  // Which of them are returned is decided with their graphs.
  options.limit = options.exact_limit;
  return options;
}

// Of a shape in itself.
ContainmentMatch WholeMatch() {
  ContainmentMatch match;
  match.votes = match.coarse_cover = match.fine_cover = 1;
  match.score = kMaxContainment;
  match.verified = true;
  match.query_coverage = match.target_coverage = 1;
  return match;
}

// From what the windows and the graphs say to what is answered.
ContainingShape Judge(RankedContainment ranked, MatchResult graph, bool generic,
                      bool same_bytes) {
  ContainingShape shape;
  shape.match = std::move(ranked.match);
  shape.graph = std::move(graph);
  shape.tied = ranked.tied;
  if (same_bytes) {
    shape.match = WholeMatch();
    shape.graph.score = 1;
  } else if (generic) {
    shape.match.verified = shape.tied = false;
    shape.match.other_places.clear();
  }
  shape.score = ContainmentScore(shape.match, shape.graph.score);
  return shape;
}

bool RanksBefore(const ContainingShape& a, const ContainingShape& b) {
  if (a.score != b.score) return a.score > b.score;
  return a.entry->record.id < b.entry->record.id;
}

}  // namespace

double ContainmentScore(const ContainmentMatch& match, double graph_score) {
  return std::clamp((match.score + kGraphWeight * graph_score) / kMaxScore, 0.0,
                    1.0);
}

std::vector<ScoreTerm> ContainmentTerms(const ContainmentMatch& match,
                                        double graph_score) {
  const double surface = (match.score - match.votes) / 2;
  return {{"windows", match.votes, 1 / kMaxScore},
          {"surface^8", surface, 2 / kMaxScore},
          {"graph", graph_score, kGraphWeight / kMaxScore}};
}

absl::StatusOr<ContainmentAnswer> ContainmentRanker::Rank(
    const GallerySnapshot& gallery, const ContainmentQuery& query,
    const StopToken& stop) const {
  ContainmentAnswer answer;
  WindowLoader loader(catalog_, gallery);
  ARGMESH_ASSIGN_OR_RETURN(
      ContainmentRanking ranking,
      RankContainment(
          query.windows, gallery.windows,
          [&](int64_t slot) { return loader.Load(slot); }, OptionsOf(query),
          [this](int64_t count, const std::function<void(int64_t)>& body) {
            pool_.ParallelFor(WorkClass::kSearch, count, body);
          },
          stop));
  Stopwatch watch;
  std::vector<MatchResult> graphs(ranking.matches.size());
  pool_.ParallelFor(
      WorkClass::kSearch, static_cast<int64_t>(graphs.size()), [&](int64_t i) {
        const auto at = static_cast<size_t>(i);
        if (!stop.Check().ok()) return;
        const GalleryEntryPtr& entry = gallery.entry(ranking.matches[at].slot);
        graphs[at] = MatchPartial(query.graph, entry->graph, query.match);
      });
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  answer.graph_time = watch.Lap();
  for (size_t i = 0; i < ranking.matches.size(); ++i) {
    RankedContainment& ranked = ranking.matches[i];
    const GalleryEntryPtr& entry = gallery.entry(ranked.slot);
    ContainingShape shape =
        Judge(std::move(ranked), std::move(graphs[i]), ranking.generic,
              entry->record.sha256 == query.sha256);
    shape.entry = entry;
    if (shape.score >= query.min_score &&
        shape.match.query_coverage >= query.min_query_coverage) {
      answer.shapes.push_back(std::move(shape));
    }
  }
  std::sort(answer.shapes.begin(), answer.shapes.end(), RanksBefore);
  answer.shapes.resize(
      std::min(answer.shapes.size(), static_cast<size_t>(query.limit)));
  answer.generic = ranking.generic;
  answer.considered = query.slots.count;
  answer.matched = ranking.loaded;
  answer.laid = ranking.laid;
  answer.damaged = loader.damaged();
  answer.candidate_time = ranking.index_time;
  answer.match_time = ranking.exact_time;
  answer.verification_time = ranking.verify_time;
  return answer;
}

absl::StatusOr<ContainingShape> ContainmentRanker::Match(
    const ContainmentPair& pair, const StopToken& stop) const {
  WindowIndex alone;
  alone.Set(0, AssignWindowWords(pair.target));
  // Borrowed for the call.
  std::shared_ptr<const TargetWindows> target(
      std::shared_ptr<const TargetWindows>(), &pair.target);
  ARGMESH_ASSIGN_OR_RETURN(
      ContainmentRanking ranking,
      RankContainment(
          pair.query, alone, [&](int64_t) { return target; }, {.limit = 1},
          [this](int64_t count, const std::function<void(int64_t)>& body) {
            pool_.ParallelFor(WorkClass::kSearch, count, body);
          },
          stop));
  return Judge(std::move(ranking.matches.at(0)),
               MatchPartial(pair.query_graph, pair.target_graph, pair.match),
               ranking.generic, pair.same_bytes);
}

}  // namespace argmesh
