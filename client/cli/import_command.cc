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

constexpr char kImportDetails[] =
    R"(Like `argmesh ingest`, but the files are on the server's machine, below the folder
that it was given with --import-root, and are read there. FOLDER is relative to
that. The collection is created when it does not exist. Links are not followed.

A file that is stored already, byte for byte, is left alone: the same command
goes on where it was interrupted. Exit code 1 when a file failed; each is named
with its reason.

Example:
  argmesh import --collection parts 2024/brackets)";

struct ImportArguments {
  std::string collection;
  std::string folder;
  bool replace = false;
};

// The collection, which may be there already.
absl::Status CreateCollection(Client& client, const std::string& id) {
  v1::CreateCollectionRequest request;
  request.set_collection_id(id);
  const absl::Status status = client.CreateCollection(request).status();
  return absl::IsAlreadyExists(status) ? absl::OkStatus() : status;
}

absl::StatusOr<int> Import(const Session& session,
                           const ImportArguments& arguments) {
  OperationRun run(session, "import");
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_RETURN_IF_ERROR(CreateCollection(*client, arguments.collection));
  v1::ImportShapesRequest request;
  request.set_parent(CollectionName(arguments.collection));
  request.set_folder(arguments.folder);
  request.set_existing_shape_policy(
      arguments.replace ? v1::EXISTING_SHAPE_POLICY_REPLACE
                        : v1::EXISTING_SHAPE_POLICY_ACCEPT_SAME_MESH);
  ARGMESH_ASSIGN_OR_RETURN(const v1::ImportShapesResponse response,
                           client->ImportShapes(request, run.Watch()));
  for (const v1::ImportFailure& failure : response.failures()) {
    run.AddFailure("path", failure.path(), failure.error());
  }
  if (session.options.json) {
    session.Print({{"collection", arguments.collection},
                   {"imported", response.imported()},
                   {"already_stored", response.already_stored()},
                   {"failed", response.failed()},
                   {"failures", run.TakeFailures()}});
  } else {
    session.out << absl::StrFormat(
        "%s: %d imported, %d already stored, %d failed\n", arguments.collection,
        response.imported(), response.already_stored(), response.failed());
  }
  return response.failed() == 0 ? kExitOk : kExitFailed;
}

}  // namespace

void AddImportCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* command = commands.Add(
      app,
      {"import", "Store mesh files of the server's machine.", kImportDetails},
      [arguments](const Session& session) {
        return Import(session, *arguments);
      });
  AddCollectionOption(command, arguments->collection);
  command->add_flag("--replace", arguments->replace,
                    "Replace stored shapes of the same id");
  command
      ->add_option("FOLDER", arguments->folder,
                   "Below the import root; all of it when left out")
      ->type_name("");
}

}  // namespace argmesh
