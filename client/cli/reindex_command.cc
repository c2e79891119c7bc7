#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/cli/operation_run.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kDetails[] =
    R"(After an upgrade that computes shapes in another way, those stored before are left
out of searches until they are described anew; this does it, from their stored
meshes, in the background of the server: searches go on. Ctrl-C stops it; the
same command goes on with the shapes that are left. Exit code 1 when a shape
failed; each is named with its reason.

Example:
  argmesh reindex parts)";

absl::StatusOr<int> Reindex(const Session& session,
                            const std::string& collection) {
  OperationRun run(session, "reindex");
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  v1::ReindexCollectionRequest request;
  request.set_name(CollectionName(collection));
  ARGMESH_ASSIGN_OR_RETURN(const v1::ReindexCollectionResponse response,
                           client->ReindexCollection(request, run.Watch()));
  for (const v1::ReindexFailure& failure : response.failures()) {
    run.AddFailure("shape", ResourceId(failure.shape()), failure.error());
  }
  if (session.options.json) {
    session.Print({{"collection", collection},
                   {"reindexed", response.reindexed()},
                   {"failed", response.failed()},
                   {"failures", run.TakeFailures()}});
  } else {
    session.out << absl::StrFormat("%s: %d shapes described anew, %d failed\n",
                                   collection, response.reindexed(),
                                   response.failed());
  }
  return response.failed() == 0 ? kExitOk : kExitFailed;
}

}  // namespace

void AddReindexCommand(CLI::App& app, CommandSet& commands) {
  const auto collection = std::make_shared<std::string>();
  CLI::App* command = commands.Add(
      app, {"reindex", "Describe shapes of an older version anew.", kDetails},
      [collection](const Session& session) {
        return Reindex(session, *collection);
      });
  command->add_option("COLLECTION", *collection, "Id of the collection")
      ->required()
      ->type_name("");
}

}  // namespace argmesh
