#include "server/rpc/convert_match.h"

#include <cmath>
#include <string>

#include "absl/strings/str_format.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

// Level scores are floats.
constexpr double kScoreTolerance = 1e-5;

void AddTerm(const LevelScore& level, double weight,
             v1::MatchExplanation* out) {
  v1::ScoreTerm& term = *out->add_terms();
  term.set_name("level " + level.name);
  term.set_value(level.score);
  term.set_weight(weight);
  term.set_contribution(weight * level.score);
}

void ExplainMean(const MatchResult& match, v1::MatchExplanation* out) {
  const size_t count = match.level_scores.size();
  double sum = 0;
  for (size_t scored = 1; scored <= count; ++scored) {
    sum += match.level_scores[count - scored].score;
    const double weight = 1.0 / static_cast<double>(scored);
    // One level alone may equal the mean of many by chance; the longest run
    // that does is as true a sum.
    if (std::abs(sum * weight - match.score) > kScoreTolerance) continue;
    out->clear_terms();
    for (size_t i = count - scored; i < count; ++i) {
      AddTerm(match.level_scores[i], weight, out);
    }
  }
}

void AddStage(const char* stage, absl::Duration elapsed, v1::SearchStats* out) {
  v1::StageTime& added = *out->add_stage_times();
  added.set_stage(stage);
  *added.mutable_elapsed() = ToDuration(elapsed);
}

}  // namespace

absl::StatusOr<MatchMode> FromProto(std::string_view field,
                                    v1::SearchMode mode) {
  switch (mode) {
    case v1::SEARCH_MODE_UNSPECIFIED:
    case v1::SEARCH_MODE_GLOBAL:
      return MatchMode::kGlobal;
    case v1::SEARCH_MODE_PARTIAL:
      return MatchMode::kPartial;
    default:
      return FieldInvalid(
          field, absl::StrFormat("%d is no mode", static_cast<int>(mode)));
  }
}

absl::StatusOr<AttributeSet> FromProto(std::string_view field,
                                       const v1::MatchParameters& parameters,
                                       MatchMode mode) {
  if (!parameters.levels().empty()) {
    return FieldInvalid(std::string(field) + ".levels",
                        "not served by this version; leave it empty");
  }
  const std::string attributes = std::string(field) + ".attributes";
  switch (parameters.attributes()) {
    case v1::ATTRIBUTE_SET_UNSPECIFIED:
    case v1::ATTRIBUTE_SET_FULL:
      return AttributeSet::kFull;
    case v1::ATTRIBUTE_SET_TUPLE:
      if (mode == MatchMode::kGlobal) return AttributeSet::kTuple;
      return FieldInvalid(attributes, "a partial search always takes all");
    default:
      return FieldInvalid(
          attributes,
          absl::StrFormat("%d is no set of attributes",
                          static_cast<int>(parameters.attributes())));
  }
}

v1::Match ToProto(const MatchResult& match) {
  v1::Match out;
  out.set_score(match.score);
  for (const LevelScore& level : match.level_scores) {
    v1::LevelScore& added = *out.add_level_scores();
    added.set_level(level.name);
    added.set_score(level.score);
  }
  out.set_best_level(match.best_level);
  out.set_query_coverage(match.query_coverage);
  out.set_target_coverage(match.target_coverage);
  for (const NodePair& pair : match.pairs) {
    v1::ComponentPair& added = *out.add_component_pairs();
    added.set_query_node(pair.query_node);
    added.set_target_node(pair.target_node);
    added.set_similarity(pair.similarity);
  }
  out.set_best_query_level(match.best_query_level);
  out.set_best_target_level(match.best_target_level);
  return out;
}

v1::MatchExplanation Explain(const MatchResult& match, MatchMode mode) {
  v1::MatchExplanation out;
  if (mode == MatchMode::kGlobal) {
    ExplainMean(match, &out);
    return out;
  }
  for (const LevelScore& level : match.level_scores) {
    if (level.name == match.best_level &&
        std::abs(level.score - match.score) <= kScoreTolerance) {
      AddTerm(level, 1.0, &out);
      break;
    }
  }
  return out;
}

v1::SearchStats ToProto(const SearchStats& stats) {
  v1::SearchStats out;
  out.set_generation(stats.generation);
  out.set_shapes_considered(stats.shapes_considered);
  out.set_candidates_ranked(stats.shapes_matched);
  out.set_exhaustive(stats.exhaustive);
  out.set_shapes_unusable(stats.shapes_unusable);
  AddStage("query", stats.query_time, &out);
  AddStage("match", stats.match_time, &out);
  AddStage("correspondence", stats.correspondence_time, &out);
  return out;
}

}  // namespace argmesh
