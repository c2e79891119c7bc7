#include "server/rpc/convert_match.h"

#include <cmath>
#include <string>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

// Level scores are floats.
constexpr double kScoreTolerance = 1e-5;

void AddTerm(const ScoreTerm& term, v1::MatchExplanation* out) {
  v1::ScoreTerm& added = *out->add_terms();
  added.set_name(term.name);
  added.set_value(term.value);
  added.set_weight(term.weight);
  added.set_contribution(term.value * term.weight);
}

void AddLevel(const LevelScore& level, double weight,
              v1::MatchExplanation* out) {
  AddTerm({"level " + level.name, level.score, weight}, out);
}

// Half the component levels, half the uniform level, which comes last.
void ExplainMean(const MatchResult& match, v1::MatchExplanation* out) {
  const std::vector<LevelScore>& levels = match.level_scores;
  const bool uniform = !levels.empty() && levels.back().name == "uniform";
  const size_t components = levels.size() - (uniform ? 1 : 0);
  const double share = uniform && components > 0 ? 0.5 : 1;
  double sum = 0;
  for (size_t i = 0; i < levels.size(); ++i) {
    const double weight =
        i < components ? share / static_cast<double>(components) : share;
    sum += weight * levels[i].score;
    AddLevel(levels[i], weight, out);
  }
  if (std::abs(sum - match.score) > kScoreTolerance) out->clear_terms();
}

void ExplainBestLevel(const MatchResult& match, v1::MatchExplanation* out) {
  for (const LevelScore& level : match.level_scores) {
    if (level.name == match.best_level &&
        std::abs(level.score - match.score) <= kScoreTolerance) {
      AddLevel(level, 1.0, out);
      break;
    }
  }
}

absl::StatusOr<AttributeSet> AttributesOf(std::string_view field,
                                          const v1::MatchParameters& parameters,
                                          MatchMode mode) {
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

absl::StatusOr<RankingMethod> RankingOf(std::string_view field,
                                        const v1::MatchParameters& parameters,
                                        bool graph_query) {
  const std::string ranking = std::string(field) + ".ranking";
  switch (parameters.ranking()) {
    case v1::RANKING_METHOD_UNSPECIFIED:
      return graph_query ? RankingMethod::kGraph : RankingMethod::kFused;
    case v1::RANKING_METHOD_FUSED:
      if (!graph_query) return RankingMethod::kFused;
      return FieldInvalid(ranking,
                          "a graph has no surface: use GRAPH, or a mesh or a "
                          "stored shape as the query");
    case v1::RANKING_METHOD_GRAPH:
      return RankingMethod::kGraph;
    default:
      return FieldInvalid(
          ranking, absl::StrFormat("%d is no ranking method",
                                   static_cast<int>(parameters.ranking())));
  }
}

v1::Handedness ToProto(Handedness handedness) {
  switch (handedness) {
    case Handedness::kSame:
      return v1::HANDEDNESS_SAME;
    case Handedness::kMirrored:
      return v1::HANDEDNESS_MIRRORED;
    case Handedness::kUndecided:
      break;
  }
  return v1::HANDEDNESS_UNSPECIFIED;
}

void AppendRows(const Eigen::Matrix4d& matrix,
                google::protobuf::RepeatedField<double>& out) {
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) out.Add(matrix(row, column));
  }
}

v1::Containment ToProto(const ContainmentMatch& match, bool tied) {
  v1::Containment out;
  out.set_verified(match.verified);
  out.set_tied(tied);
  out.set_window_score(match.votes);
  out.set_surface_score(match.fine_cover);
  if (match.coarse_cover > 0) {
    AppendRows(match.transform, *out.mutable_transform());
  }
  for (const Eigen::Matrix4d& place : match.other_places) {
    AppendRows(place, *out.add_other_places()->mutable_transform());
  }
  out.set_inside_out(match.flipped);
  return out;
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

absl::StatusOr<MatchSettings> FromProto(std::string_view field,
                                        const v1::MatchParameters& parameters,
                                        MatchMode mode, bool graph_query) {
  MatchSettings settings;
  settings.levels.assign(parameters.levels().begin(),
                         parameters.levels().end());
  ARGMESH_ASSIGN_OR_RETURN(settings.attributes,
                           AttributesOf(field, parameters, mode));
  ARGMESH_ASSIGN_OR_RETURN(settings.ranking,
                           RankingOf(field, parameters, graph_query));
  settings.rerank = parameters.rerank();
  if (settings.rerank && settings.ranking != RankingMethod::kFused) {
    return FieldInvalid(std::string(field) + ".rerank",
                        "only a search with the fused ranking has it");
  }
  return settings;
}

v1::Match ToProto(const SearchMatch& found) {
  const MatchResult& match = found.match;
  v1::Match out;
  out.set_score(found.score);
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
  out.set_handedness(ToProto(found.handedness));
  if (found.containment) {
    *out.mutable_containment() = ToProto(*found.containment, found.tied);
  }
  return out;
}

v1::MatchExplanation Explain(const SearchMatch& match, MatchMode mode) {
  v1::MatchExplanation out;
  out.set_candidate_rank(match.candidate_rank);
  if (!match.terms.empty()) {
    for (const ScoreTerm& term : match.terms) AddTerm(term, &out);
  } else if (mode == MatchMode::kGlobal) {
    ExplainMean(match.match, &out);
  } else {
    ExplainBestLevel(match.match, &out);
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
  for (const StageTime& stage : stats.stages) {
    v1::StageTime& added = *out.add_stage_times();
    added.set_stage(stage.stage);
    *added.mutable_elapsed() = ToDuration(stage.elapsed);
  }
  return out;
}

}  // namespace argmesh
