// What `argmesh evaluate` does: many queries, their ranked answers against the
// classes of the shapes.
//
// Without a table of queries every shape that has a class is the query once,
// and is left out of its own answer. With one, the queries are mesh files; the
// shape that a query was made from is left out of its answer.
#ifndef ARGMESH_CLIENT_CLI_EVALUATION_RUN_H_
#define ARGMESH_CLIENT_CLI_EVALUATION_RUN_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/cli/json.h"
#include "client/cli/search_options.h"
#include "client/cli/session.h"

namespace argmesh {

struct EvaluateArguments {
  MatchArguments match;
  std::string filter;   // only shapes it holds for; empty: all
  std::string queries;  // table of query files; empty: leave one out
  std::string scores;   // file for the raw scores; empty for none
  int jobs = 2;         // queries at a time
  bool exact = false;
  bool rerank = false;
};

// Of one query, or the mean of many.
struct EvaluationMeasures {
  int64_t queries = 0;
  double nn = 0;   // nearest neighbour
  double ft = 0;   // first tier
  double st = 0;   // second tier
  double e = 0;    // E-measure
  double dcg = 0;  // normalised discounted cumulative gain
};

struct QueryMeasures {
  std::string query;
  std::string label;
  EvaluationMeasures measures;  // of this query alone
  // Of the shape the query was made from: 1 when it came first, 0 when it was
  // not found or there is none.
  int64_t source_rank = 0;
};

struct EvaluationFailure {
  std::string query;
  absl::Status status;
};

struct Evaluation {
  std::string collection;
  std::string mode;
  int64_t shapes = 0;  // with a class
  EvaluationMeasures mean;
  std::map<std::string, EvaluationMeasures> per_class;
  std::vector<QueryMeasures> per_query;
  // Queries whose class has no shape to be found.
  int64_t skipped = 0;
  std::vector<EvaluationFailure> failures;

  // Mean score of the shapes of class j for the queries of class i.
  std::vector<std::string> classes;
  std::vector<std::vector<double>> matrix;

  // With queries made from stored shapes: how many, and the share of them
  // whose shape came first, or among the first five.
  int64_t with_source = 0;
  double source_first = 0;
  double source_top5 = 0;
  // Of the same queries: the share whose shape was verified to contain them,
  // and the share for which a shape of another class was.
  double source_verified = 0;
  double other_verified = 0;
  bool has_sources = false;  // the queries came from a table

  double seconds = 0;
};

absl::StatusOr<Evaluation> RunEvaluation(const Session& session,
                                         const EvaluateArguments& arguments);

Json ToJson(const Evaluation& evaluation);
std::string ToText(const Evaluation& evaluation);

// Row i: its diagonal entry less its largest other one.
std::vector<double> RowMargins(const std::vector<std::vector<double>>& matrix);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_EVALUATION_RUN_H_
