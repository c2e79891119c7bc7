#include <memory>
#include <span>

#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/cli/match_table.h"
#include "client/cli/search_options.h"
#include "client/cli/text_table.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kCompareDetails[] =
    R"(A and B are ids of stored shapes or mesh files; a name of an existing file is the
file. Nothing is stored. With --mode partial A is looked for in B.

Examples:
  argmesh compare --collection parts valve-7 valve-9
  argmesh compare --collection parts --mode partial piece.obj valve-7 --json)";

struct CompareArguments {
  MatchArguments match;
  std::string a;
  std::string b;
  bool explain = false;
};

void PrintForPeople(const Session& session, const CompareArguments& arguments,
                    const v1::Match& match) {
  TextTable table({"level", ">score"});
  for (const v1::LevelScore& level : match.level_scores()) {
    table.AddRow({level.level(), FormatNumber(level.score(), 4)});
  }
  session.out << absl::StrFormat("%s and %s, %s: score %.4f\n\n",
                                 Printable(arguments.a), Printable(arguments.b),
                                 arguments.match.mode, match.score())
              << table.ToString()
              << absl::StrFormat(
                     "\nbest level %s: %d pairs of components cover %.0f%% of "
                     "%s and %.0f%% of %s\n",
                     match.best_level(), match.component_pairs_size(),
                     100 * match.query_coverage(), Printable(arguments.a),
                     100 * match.target_coverage(), Printable(arguments.b));
  if (arguments.explain) {
    session.out << ExplanationText(std::span(&match, 1));
  }
}

absl::StatusOr<int> Compare(const Session& session,
                            const CompareArguments& arguments) {
  const std::string& collection = arguments.match.collection;
  v1::CompareShapesRequest request;
  request.set_parent(CollectionName(collection));
  ARGMESH_ASSIGN_OR_RETURN(*request.mutable_query(),
                           MakeShapeReference(collection, arguments.a));
  ARGMESH_ASSIGN_OR_RETURN(*request.mutable_target(),
                           MakeShapeReference(collection, arguments.b));
  if (request.ByteSizeLong() > (4 << 20) - (32 << 10)) {
    return UsageError(
        "both meshes together are too large for one message; ingest one of "
        "them first");
  }
  request.set_mode(ModeOf(arguments.match));
  *request.mutable_parameters() = ParametersOf(arguments.match);
  request.set_explain(arguments.explain);
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const v1::CompareShapesResponse response,
                           client->CompareShapes(request));
  if (!session.options.json) {
    PrintForPeople(session, arguments, response.match());
    return kExitOk;
  }
  Json json = {
      {"a", arguments.a}, {"b", arguments.b}, {"mode", arguments.match.mode}};
  json.update(ToJson(response.match()));
  session.Print(json);
  return kExitOk;
}

}  // namespace

void AddCompareCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command =
      commands.Add(app,
                   {"compare", "Say how alike two shapes are, level by level.",
                    kCompareDetails},
                   [arguments](const Session& session) {
                     return Compare(session, *arguments);
                   });
  AddMatchOptions(command, arguments->match);
  command->add_flag("--explain", arguments->explain,
                    "Show what the score adds up from");
  command->add_option("A", arguments->a, "Shape id or mesh file, the query")
      ->required()
      ->type_name("");
  command->add_option("B", arguments->b, "Shape id or mesh file, the target")
      ->required()
      ->type_name("");
}

}  // namespace argmesh
