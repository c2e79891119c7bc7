#include <memory>
#include <vector>

#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/cli/match_table.h"
#include "client/cli/search_options.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kSearchDetails[] =
    R"(The query is a mesh file, or a stored shape by --shape; that one is left out of
its own answer unless --include-self is given; --region makes components of it
the query. "query" and "target" are the shares of each side's area that match.

A global search ranks by graphs and shape signatures, a partial one by windows
of the surface, laid onto each candidate: it says where the query lies and
whether that was verified. --ranking graph ranks by graphs alone.

Examples:
  argmesh search --collection parts --mode global query.stl
  argmesh search --collection parts --mode partial --shape valve-7 --limit 20
  argmesh search --collection parts --mode partial --shape valve-7 --region 3,4
  argmesh search --collection parts --mode global --explain --json query.off)";

absl::StatusOr<int> Search(const Session& session,
                           const SearchArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const v1::SearchShapesRequest request,
                           MakeSearchRequest(arguments));
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const v1::SearchShapesResponse response,
                           client->SearchShapes(request));
  if (session.options.json) {
    Json matches = Json::array();
    for (const v1::Match& match : response.matches()) {
      matches.push_back(ToJson(match));
    }
    session.Print({{"matches", std::move(matches)},
                   {"stats", ToJson(response.stats())},
                   {"query_generic", response.query_generic()},
                   {"truncated", response.truncated()}});
    return kExitOk;
  }
  const std::vector<v1::Match> matches(response.matches().begin(),
                                       response.matches().end());
  session.out << MatchTable(matches);
  if (arguments.explain) session.out << ExplanationText(matches);
  const v1::SearchStats& stats = response.stats();
  session.out << absl::StrFormat(
      "%d of %d shapes, %s\n", response.matches_size(),
      stats.shapes_considered(),
      stats.exhaustive()
          ? "all of them matched"
          : absl::StrFormat("%d of them matched", stats.candidates_ranked()));
  if (stats.shapes_unusable() > 0) {
    session.Note(absl::StrFormat(
        "%d shapes cannot be searched: damaged or of another version",
        stats.shapes_unusable()));
  }
  if (response.query_generic()) {
    session.Note(
        "the query has too few features to say which shape it is a part of");
  }
  if (response.truncated()) {
    session.Note("the answer was cut to fit in a message; use --limit");
  }
  return kExitOk;
}

}  // namespace

void AddSearchCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<SearchArguments>();
  CLI::App* command = commands.Add(
      app, {"search", "Find shapes like a query, best first.", kSearchDetails},
      [arguments](const Session& session) {
        return Search(session, *arguments);
      });
  AddSearchOptions(command, *arguments);
  command->add_flag("--explain", arguments->explain,
                    "Show what each score adds up from");
}

}  // namespace argmesh
