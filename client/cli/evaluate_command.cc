#include <memory>

#include "client/cli/command_set.h"
#include "client/cli/evaluation_run.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kEvaluateDetails[] =
    R"(Every shape with a class (see `argmesh ingest --labels`) is the query once, is
left out of its own answer, and the others should rank those of its class first.
Shown are nearest neighbour, first and second tier, E-measure and DCG, 0 to 1.

With --queries the queries are mesh files: lines `path TAB class TAB source`,
the path relative to the file of queries, the source the shape a query was made
from (its source_uri or id, `-` for none). It is left out of the measures;
source_first and source_top5 say how often it came first or among five.

With --filter only the shapes it holds for are queries and found.

Examples:
  argmesh evaluate --collection bench --mode global
  argmesh evaluate --collection bench --mode partial --queries cuts.tsv --json)";

absl::StatusOr<int> Evaluate(const Session& session,
                             const EvaluateArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const Evaluation evaluation,
                           RunEvaluation(session, arguments));
  for (const EvaluationFailure& failure : evaluation.failures) {
    session.Note(failure.query + ": " + std::string(failure.status.message()));
  }
  if (session.options.json) {
    session.Print(ToJson(evaluation));
  } else {
    session.out << ToText(evaluation);
  }
  return evaluation.failures.empty() ? kExitOk : kExitFailed;
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command =
      commands.Add(app,
                   {"evaluate", "Measure how well a collection is searched.",
                    kEvaluateDetails},
                   [arguments](const Session& session) {
                     return Evaluate(session, *arguments);
                   });
  AddMatchOptions(command, arguments->match);
  AddFilterOption(command, arguments->filter);
  command->add_option("--queries", arguments->queries, "Table of query files")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command->add_option("--jobs,-j", arguments->jobs, "Queries at a time")
      ->type_name("N")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--exact", arguments->exact,
                    "Have every shape matched, whatever the first stage says");
  AddRerankOption(command, arguments->rerank);
  command
      ->add_option("--scores", arguments->scores,
                   "Write the score of every pair as a table")
      ->type_name("FILE");
}

}  // namespace argmesh
