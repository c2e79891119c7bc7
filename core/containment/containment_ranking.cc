#include "core/containment/containment_ranking.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/base/stopwatch.h"
#include "core/containment/prepared_target.h"

namespace argmesh {
namespace {

// Windows below the first say too little whatever is found, above the second
// enough.
constexpr double kIndistinct = 0.28;
constexpr double kDistinctive = 0.4;
constexpr double kCovered = 0.9;      // F that counts as lying on a shape
constexpr double kCommonShare = 0.1;  // of verified shapes: too many,
constexpr int64_t kCommonShapes = 3;  // if there are so many of them
constexpr double kTieMargin = 0.1;    // of scores
// Votes inside out, in votes as given, from which on that is tried.
constexpr double kWorthTurning = 0.9;
constexpr float kSettled = 0.98F;  // F that more effort cannot raise much

absl::Status CheckLimit(const char* name, int value) {
  if (value >= 1) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrFormat("%s is %d, at least 1", name, value));
}

absl::Status CheckOptions(const RankContainmentOptions& options) {
  ARGMESH_RETURN_IF_ERROR(CheckLimit("limit", options.limit));
  ARGMESH_RETURN_IF_ERROR(CheckLimit("exact_limit", options.exact_limit));
  ARGMESH_RETURN_IF_ERROR(CheckLimit("verify_limit", options.verify_limit));
  ARGMESH_RETURN_IF_ERROR(CheckLimit("thorough_limit", options.thorough_limit));
  ARGMESH_RETURN_IF_ERROR(CheckLimit("keep_limit", options.keep_limit));
  return absl::OkStatus();
}

// One shape on its way through the chain.
struct Candidate {
  ShapeVotes votes;
  bool loaded = false;
  std::shared_ptr<const TargetWindows> windows;  // null: not kept
  ContainmentMatch match;
};

// body(candidate) for every candidate; the first error in their order.
absl::Status ForEach(const ParallelRunner& parallel_for,
                     std::span<Candidate> candidates,
                     const std::function<absl::Status(Candidate&)>& body) {
  std::vector<absl::Status> statuses(candidates.size());
  const auto run = [&](int64_t i) {
    const auto at = static_cast<size_t>(i);
    statuses[at] = body(candidates[at]);
  };
  const auto count = static_cast<int64_t>(candidates.size());
  if (parallel_for) {
    parallel_for(count, run);
  } else {
    for (int64_t i = 0; i < count; ++i) run(i);
  }
  for (const absl::Status& status : statuses) ARGMESH_RETURN_IF_ERROR(status);
  return absl::OkStatus();
}

template <typename Score>
void KeepBest(std::vector<Candidate>& candidates, int limit, Score score) {
  std::sort(candidates.begin(), candidates.end(),
            [&](const Candidate& a, const Candidate& b) {
              const double x = score(a);
              const double y = score(b);
              return x != y ? x > y : a.votes.slot < b.votes.slot;
            });
  candidates.resize(std::min(candidates.size(), static_cast<size_t>(limit)));
}

class Chain {
 public:
  Chain(const QueryWindows& query, const WindowIndex& index,
        const LoadWindows& load, const RankContainmentOptions& options,
        const ParallelRunner& parallel_for, const StopToken& stop, bool flipped)
      : query_(query),
        index_(index),
        load_(load),
        options_(options),
        parallel_for_(parallel_for),
        stop_(stop),
        flipped_(flipped) {}

  absl::Status Vote() {
    Stopwatch watch;
    VoteOptions vote_options;
    vote_options.limit = std::max(options_.exact_limit, options_.limit);
    vote_options.flipped = flipped_;
    vote_options.slots = options_.slots;
    ARGMESH_ASSIGN_OR_RETURN(votes_, index_.Vote(query_, vote_options, stop_));
    index_time_ = watch.Lap();
    return absl::OkStatus();
  }

  // The most that any shape got in Vote.
  double MostVotes() const {
    return votes_.shapes.empty() ? 0 : votes_.shapes.front().score;
  }

  absl::Duration index_time() const { return index_time_; }

  // After Vote.
  absl::StatusOr<ContainmentRanking> Finish() {
    Stopwatch watch;
    ContainmentRanking ranking;
    ranking.considered = index_.size();
    ranking.distinctiveness = votes_.distinctiveness;
    ranking.index_time = index_time_;
    ARGMESH_RETURN_IF_ERROR(VoteOnWindows());
    ranking.loaded = static_cast<int64_t>(candidates_.size());
    ranking.exact_time = watch.Lap();
    ARGMESH_RETURN_IF_ERROR(Verify());
    ranking.laid = static_cast<int64_t>(num_verified_);
    Report(ranking);
    ranking.verify_time = watch.Lap();
    return ranking;
  }

 private:
  absl::Status VoteOn(Candidate& candidate) const {
    ARGMESH_RETURN_IF_ERROR(stop_.Check());
    ARGMESH_ASSIGN_OR_RETURN(const auto windows, load_(candidate.votes.slot));
    if (windows == nullptr) return absl::OkStatus();
    candidate.loaded = true;
    if (&candidate - candidates_.data() < options_.keep_limit) {
      candidate.windows = windows;
    }
    candidate.votes =
        VoteExactly(query_, votes_, candidate.votes, flipped_, *windows);
    candidate.match.votes = candidate.votes.score;
    candidate.match.score = candidate.votes.score;
    candidate.match.flipped = flipped_;
    return absl::OkStatus();
  }

  VerifyOptions OptionsOf(bool thorough) const {
    VerifyOptions verify;
    verify.thorough = thorough;
    verify.flipped = flipped_;
    verify.seed = options_.seed + (thorough ? 1 : 0);
    verify.weights = votes_.weights;
    return verify;
  }

  absl::Status VerifyOne(Candidate& candidate, bool thorough) const {
    ARGMESH_RETURN_IF_ERROR(stop_.Check());
    const bool settled = candidate.match.fine_cover >= kSettled;
    if (settled && !thorough) return absl::OkStatus();
    std::shared_ptr<const TargetWindows> windows = candidate.windows;
    if (windows == nullptr) {
      ARGMESH_ASSIGN_OR_RETURN(windows, load_(candidate.votes.slot));
      if (windows == nullptr) return absl::OkStatus();
    }
    const PreparedTarget target(*windows);
    const VerifyOptions verify = OptionsOf(thorough);
    if (!settled) {
      ARGMESH_ASSIGN_OR_RETURN(
          ContainmentMatch match,
          VerifyContainment(query_, target, candidate.votes, verify, stop_));
      if (match.score >= candidate.match.score) {
        candidate.match = std::move(match);
      }
    }
    if (!thorough || !candidate.match.verified) return absl::OkStatus();
    ARGMESH_ASSIGN_OR_RETURN(candidate.match.other_places,
                             FindOtherPlaces(query_, target, candidate.votes,
                                             candidate.match, verify, stop_));
    return absl::OkStatus();
  }

  absl::Status VoteOnWindows() {
    for (const ShapeVotes& votes : votes_.shapes) {
      candidates_.push_back({votes, false, nullptr, {}});
    }
    ARGMESH_RETURN_IF_ERROR(
        ForEach(parallel_for_, candidates_,
                [this](Candidate& candidate) { return VoteOn(candidate); }));
    std::erase_if(candidates_,
                  [](const Candidate& candidate) { return !candidate.loaded; });
    KeepBest(candidates_, options_.exact_limit,
             [](const Candidate& c) { return c.votes.score; });
    return absl::OkStatus();
  }

  absl::Status Verify() {
    num_verified_ = std::min(candidates_.size(),
                             static_cast<size_t>(options_.verify_limit));
    ARGMESH_RETURN_IF_ERROR(VerifyFirst(num_verified_, /*thorough=*/false));
    const auto verified =
        candidates_.begin() + static_cast<std::ptrdiff_t>(num_verified_);
    std::sort(candidates_.begin(), verified,
              [](const Candidate& a, const Candidate& b) {
                const double x = Promise(a.match);
                const double y = Promise(b.match);
                return x != y ? x > y : a.votes.slot < b.votes.slot;
              });
    return VerifyFirst(
        std::min(num_verified_, static_cast<size_t>(options_.thorough_limit)),
        /*thorough=*/true);
  }

  static double Promise(const ContainmentMatch& match) {
    return match.votes + match.coarse_cover + match.fine_cover;
  }

  absl::Status VerifyFirst(size_t count, bool thorough) {
    return ForEach(parallel_for_, std::span(candidates_).first(count),
                   [this, thorough](Candidate& candidate) {
                     return VerifyOne(candidate, thorough);
                   });
  }

  void Report(ContainmentRanking& ranking) {
    const auto covered = std::count_if(
        candidates_.begin(),
        candidates_.begin() + static_cast<std::ptrdiff_t>(num_verified_),
        [](const Candidate& c) { return c.match.fine_cover > kCovered; });
    const bool common = covered >= kCommonShapes &&
                        static_cast<double>(covered) >
                            kCommonShare * static_cast<double>(num_verified_);
    ranking.generic = ranking.distinctiveness < kIndistinct ||
                      (ranking.distinctiveness < kDistinctive && common);
    KeepBest(candidates_, options_.limit,
             [](const Candidate& c) { return c.match.score; });
    for (const Candidate& candidate : candidates_) {
      ranking.matches.push_back({candidate.votes.slot, candidate.match, false});
    }
    MarkTies(ranking.matches);
  }

  static void MarkTies(std::vector<RankedContainment>& matches) {
    for (size_t i = 0; i < matches.size(); ++i) {
      const ContainmentMatch& match = matches[i].match;
      if (!match.verified) continue;
      matches[i].tied |= !match.other_places.empty();
      if (i == 0 || !matches[0].match.verified ||
          match.score < matches[0].match.score - kTieMargin) {
        continue;
      }
      matches[0].tied = matches[i].tied = true;
    }
  }

  const QueryWindows& query_;
  const WindowIndex& index_;
  const LoadWindows& load_;
  const RankContainmentOptions& options_;
  const ParallelRunner& parallel_for_;
  const StopToken& stop_;
  const bool flipped_;
  VoteResult votes_;
  std::vector<Candidate> candidates_;
  size_t num_verified_ = 0;
  absl::Duration index_time_;
};

bool AnyVerified(const ContainmentRanking& ranking) {
  return std::any_of(
      ranking.matches.begin(), ranking.matches.end(),
      [](const RankedContainment& ranked) { return ranked.match.verified; });
}

}  // namespace

absl::StatusOr<ContainmentRanking> RankContainment(
    const QueryWindows& query, const WindowIndex& index,
    const LoadWindows& load, const RankContainmentOptions& options,
    const ParallelRunner& parallel_for, const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(CheckOptions(options));
  Chain given(query, index, load, options, parallel_for, stop, false);
  ARGMESH_RETURN_IF_ERROR(given.Vote());
  const double most_votes = given.MostVotes();
  ARGMESH_ASSIGN_OR_RETURN(ContainmentRanking ranking, given.Finish());
  if (!options.try_flipped || AnyVerified(ranking)) return ranking;
  Chain turned(query, index, load, options, parallel_for, stop, true);
  ARGMESH_RETURN_IF_ERROR(turned.Vote());
  if (turned.MostVotes() < kWorthTurning * most_votes) {
    ranking.index_time += turned.index_time();
    return ranking;
  }
  ARGMESH_ASSIGN_OR_RETURN(ContainmentRanking flipped, turned.Finish());
  if (AnyVerified(flipped)) std::swap(ranking, flipped);
  ranking.index_time += flipped.index_time;
  ranking.exact_time += flipped.exact_time;
  ranking.verify_time += flipped.verify_time;
  return ranking;
}

}  // namespace argmesh
