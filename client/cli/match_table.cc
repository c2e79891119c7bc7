#include "client/cli/match_table.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "client/cli/json.h"
#include "client/cli/text_table.h"
#include "client/resource_name.h"

namespace argmesh {
namespace {

// The levels of all matches in the order they come.
std::vector<std::string> LevelNames(std::span<const v1::Match> matches) {
  std::vector<std::string> names;
  for (const v1::Match& match : matches) {
    for (const v1::LevelScore& level : match.level_scores()) {
      if (std::find(names.begin(), names.end(), level.level()) == names.end()) {
        names.push_back(level.level());
      }
    }
  }
  return names;
}

// What there is to say of a match beside its numbers.
std::string NoteOf(const v1::Match& match) {
  std::vector<std::string> notes;
  if (match.handedness() == v1::HANDEDNESS_MIRRORED) {
    notes.emplace_back("mirrored");
  }
  const v1::Containment& containment = match.containment();
  if (containment.verified()) notes.emplace_back("contains the query");
  if (containment.other_places_size() > 0) {
    notes.push_back("at " +
                    std::to_string(containment.other_places_size() + 1) +
                    " places");
  }
  if (containment.inside_out()) notes.emplace_back("inside out");
  if (containment.tied()) notes.emplace_back("tied");
  return absl::StrJoin(notes, ", ");
}

std::string Percent(double share) { return FormatNumber(share * 100, 0) + "%"; }

}  // namespace

std::string MatchTable(std::span<const v1::Match> matches) {
  const std::vector<std::string> levels = LevelNames(matches);
  std::vector<std::string> headers = {">#", "shape", "class", ">score"};
  for (const std::string& level : levels) headers.push_back(">" + level);
  headers.insert(headers.end(), {"best level", ">query", ">target", "note"});
  TextTable table(headers);
  for (size_t i = 0; i < matches.size(); ++i) {
    const v1::Match& match = matches[i];
    std::vector<std::string> row = {
        std::to_string(i + 1), ResourceId(match.shape().name()),
        ClassOf(match.shape()), FormatNumber(match.score(), 4)};
    std::map<std::string, double> scores;
    for (const v1::LevelScore& level : match.level_scores()) {
      scores[level.level()] = level.score();
    }
    for (const std::string& level : levels) {
      const auto score = scores.find(level);
      row.push_back(score == scores.end() ? ""
                                          : FormatNumber(score->second, 3));
    }
    row.push_back(match.best_level());
    row.push_back(Percent(match.query_coverage()));
    row.push_back(Percent(match.target_coverage()));
    row.push_back(NoteOf(match));
    table.AddRow(std::move(row));
  }
  return table.ToString();
}

std::string ExplanationText(std::span<const v1::Match> matches) {
  std::string text;
  for (const v1::Match& match : matches) {
    if (!match.has_explanation()) continue;
    const v1::MatchExplanation& explanation = match.explanation();
    text += absl::StrFormat("\n%s: %d matched components, score %.4f\n",
                            ResourceId(match.shape().name()),
                            match.component_pairs_size(), match.score());
    if (explanation.candidate_rank() > 0) {
      text += absl::StrFormat("  rank %d of the first stage\n",
                              explanation.candidate_rank());
    }
    for (const v1::ScoreTerm& term : explanation.terms()) {
      text +=
          absl::StrFormat("  %8.4f = %.4f x %.4f  %s\n", term.contribution(),
                          term.value(), term.weight(), Printable(term.name()));
    }
  }
  return text;
}

}  // namespace argmesh
