// What people and programs are told of an evaluation.
#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_format.h"
#include "client/cli/evaluation_run.h"
#include "client/cli/text_table.h"
#include "client/error_status.h"

namespace argmesh {
namespace {

Json MeasuresToJson(const EvaluationMeasures& measures) {
  return {{"queries", measures.queries},
          {"nn", measures.nn},
          {"ft", measures.ft},
          {"st", measures.st},
          {"e", measures.e},
          {"dcg", measures.dcg}};
}

Json QueriesToJson(const std::vector<QueryMeasures>& queries) {
  Json list = Json::array();
  for (const QueryMeasures& query : queries) {
    Json entry = {{"query", query.query}, {"class", query.label}};
    entry.update(MeasuresToJson(query.measures));
    entry.erase("queries");
    if (query.source_rank > 0) entry["source_rank"] = query.source_rank;
    list.push_back(std::move(entry));
  }
  return list;
}

std::vector<std::string> MeasuresRow(const std::string& name,
                                     const EvaluationMeasures& measures) {
  std::vector<std::string> row = {name, std::to_string(measures.queries)};
  for (const double value :
       {measures.nn, measures.ft, measures.st, measures.e, measures.dcg}) {
    row.push_back(FormatNumber(value, 3));
  }
  return row;
}

// Every class that has a score with itself scores highest with itself.
bool DiagonalIsRowMaximum(const std::vector<double>& margins) {
  return std::none_of(margins.begin(), margins.end(),
                      [](double margin) { return margin <= 0; });
}

Json MatrixToJson(const Evaluation& evaluation) {
  const std::vector<double> margins = RowMargins(evaluation.matrix);
  return {{"classes", evaluation.classes},
          {"mean_score", evaluation.matrix},
          {"margins", margins},
          {"diagonal_is_row_maximum", DiagonalIsRowMaximum(margins)}};
}

}  // namespace

Json ToJson(const Evaluation& evaluation) {
  Json per_class = Json::object();
  for (const auto& [label, measures] : evaluation.per_class) {
    per_class[label] = MeasuresToJson(measures);
  }
  Json failures = Json::array();
  for (const EvaluationFailure& failure : evaluation.failures) {
    Json entry = {{"query", failure.query}};
    entry.update(ErrorToJson(failure.status));
    failures.push_back(std::move(entry));
  }
  Json json = {{"collection", evaluation.collection},
               {"mode", evaluation.mode},
               {"shapes", evaluation.shapes}};
  json.update(MeasuresToJson(evaluation.mean));
  if (evaluation.has_sources) {
    json["with_source"] = evaluation.with_source;
    json["source_first"] = evaluation.source_first;
    json["source_top5"] = evaluation.source_top5;
    json["source_verified"] = evaluation.source_verified;
    json["other_class_verified"] = evaluation.other_verified;
  }
  json["per_class"] = std::move(per_class);
  json["per_query"] = QueriesToJson(evaluation.per_query);
  json["matrix"] = MatrixToJson(evaluation);
  json["skipped"] = evaluation.skipped;
  json["failed"] = evaluation.failures.size();
  json["failures"] = std::move(failures);
  json["seconds"] = evaluation.seconds;
  return json;
}

std::string ToText(const Evaluation& evaluation) {
  const std::vector<double> margins = RowMargins(evaluation.matrix);
  TextTable table({"class", ">queries", ">NN", ">1st tier", ">2nd tier", ">E",
                   ">DCG", ">margin"});
  for (size_t i = 0; i < evaluation.classes.size(); ++i) {
    const auto measures = evaluation.per_class.find(evaluation.classes[i]);
    if (measures == evaluation.per_class.end()) continue;
    std::vector<std::string> row =
        MeasuresRow(evaluation.classes[i], measures->second);
    row.push_back(std::isnan(margins[i]) ? "" : FormatNumber(margins[i], 3));
    table.AddRow(std::move(row));
  }
  table.AddRow(MeasuresRow("all", evaluation.mean));
  std::string text = absl::StrFormat(
      "%s, %s: %d queries against %d shapes in %.1f s\n\n%s",
      evaluation.collection, evaluation.mode, evaluation.mean.queries,
      evaluation.shapes, evaluation.seconds, table.ToString());
  text += absl::StrFormat(
      "\nmargin: mean score within the class less the best with another; %s\n",
      DiagonalIsRowMaximum(margins) ? "every class is most like itself"
                                    : "not every class is most like itself");
  if (evaluation.has_sources && evaluation.with_source > 0) {
    text += absl::StrFormat(
        "source found first %.3f, among the first five %.3f, verified %.3f, a "
        "shape of another class verified %.3f, of %d queries\n",
        evaluation.source_first, evaluation.source_top5,
        evaluation.source_verified, evaluation.other_verified,
        evaluation.with_source);
  }
  if (evaluation.skipped > 0) {
    text += absl::StrFormat(
        "%d queries were left out: their class has no other shape\n",
        evaluation.skipped);
  }
  return text;
}

}  // namespace argmesh
