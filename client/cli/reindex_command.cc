#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/cli/decomposition_option.h"
#include "client/cli/json.h"
#include "client/cli/operation_run.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kReindexDetails[] =
    R"(After an upgrade that computes shapes in another way, those stored before are left
out of searches until they are described anew; this does it, from their stored
meshes, in the background of the server: searches go on. Ctrl-C stops it; the
same command goes on with the shapes that are left. Exit code 1 when a shape
failed; each is named with its reason.

With one of the settings, every shape is described with it; settings that are
not named stay those of the collection. Searches go on with what was there
before until all shapes are done, and then change over at once. When a shape
fails the collection stays as it was: delete or replace that shape, and give the
same command again.

Examples:
  argmesh reindex parts
  argmesh reindex parts --vertex-budget 5000)";

struct ReindexArguments {
  std::string collection;
  std::string decomposition;
  std::optional<int> vertex_budget;
  std::optional<int> uniform_cells;
};

// None: no setting was named.
std::optional<v1::CollectionSettings> SettingsOf(
    const ReindexArguments& arguments) {
  v1::CollectionSettings settings;
  settings.set_decomposition(DecompositionOf(arguments.decomposition));
  if (arguments.vertex_budget) {
    settings.set_vertex_budget(*arguments.vertex_budget);
  }
  if (arguments.uniform_cells) {
    settings.set_uniform_cells(*arguments.uniform_cells);
  }
  if (arguments.decomposition.empty() && !arguments.vertex_budget &&
      !arguments.uniform_cells) {
    return std::nullopt;
  }
  return settings;
}

absl::StatusOr<int> Reindex(const Session& session,
                            const ReindexArguments& arguments) {
  const std::string& collection = arguments.collection;
  OperationRun run(session, "reindex");
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  v1::ReindexCollectionRequest request;
  request.set_name(CollectionName(collection));
  if (const auto settings = SettingsOf(arguments)) {
    *request.mutable_settings() = *settings;
  }
  ARGMESH_ASSIGN_OR_RETURN(const v1::ReindexCollectionResponse response,
                           client->ReindexCollection(request, run.Watch()));
  for (const v1::ReindexFailure& failure : response.failures()) {
    run.AddFailure("shape", ResourceId(failure.shape()), failure.error());
  }
  const v1::CollectionSettings& settings = response.collection().settings();
  if (session.options.json) {
    session.Print(
        {{"collection", collection},
         {"reindexed", response.reindexed()},
         {"failed", response.failed()},
         {"failures", run.TakeFailures()},
         {"decomposition", DecompositionName(settings.decomposition())},
         {"vertex_budget", settings.vertex_budget()},
         {"uniform_cells", settings.uniform_cells()},
         {"generation", response.collection().generation()}});
  } else {
    session.out << absl::StrFormat(
        "%s: %d shapes described anew, %d failed\n"
        "settings: %s, vertex budget %d, uniform cells %d\n",
        collection, response.reindexed(), response.failed(),
        DecompositionName(settings.decomposition()), settings.vertex_budget(),
        settings.uniform_cells());
  }
  return response.failed() == 0 ? kExitOk : kExitFailed;
}

}  // namespace

void AddReindexCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<ReindexArguments>();
  CLI::App* command = commands.Add(
      app,
      {"reindex",
       "Describe shapes anew: of an older version, or with other settings.",
       kReindexDetails},
      [arguments](const Session& session) {
        return Reindex(session, *arguments);
      });
  AddDecompositionOption(command, arguments->decomposition,
                         "Into which components surfaces are decomposed");
  command
      ->add_option("--vertex-budget", arguments->vertex_budget,
                   "Vertices that a surface is resampled to")
      ->type_name("N")
      ->check(CLI::Range(100, 100000));
  command
      ->add_option("--uniform-cells", arguments->uniform_cells,
                   "Cells of equal size beside the components; 0: none")
      ->type_name("N")
      ->check(CLI::Range(0, 1000));
  command
      ->add_option("COLLECTION", arguments->collection, "Id of the collection")
      ->required()
      ->type_name("");
}

}  // namespace argmesh
