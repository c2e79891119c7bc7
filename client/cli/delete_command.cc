#include <memory>
#include <vector>

#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/error_status.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kDeleteDetails[] =
    R"(With ids these shapes are removed, without any the collection; one that still has
shapes only with --force. There is no way back.

Examples:
  argmesh delete --collection parts valve-7 valve-9
  argmesh delete --collection parts --force)";

struct DeleteArguments {
  std::string collection;
  std::vector<std::string> shapes;
  bool force = false;
};

absl::StatusOr<int> DeleteShapes(const Session& session, Client& client,
                                 const DeleteArguments& arguments) {
  Json deleted = Json::array();
  Json failures = Json::array();
  for (const std::string& shape : arguments.shapes) {
    v1::DeleteShapeRequest request;
    request.set_name(ShapeName(arguments.collection, shape));
    const auto response = client.DeleteShape(request);
    if (IsUnreachable(response.status())) return response.status();
    if (response.ok()) {
      deleted.push_back(shape);
      continue;
    }
    session.Note(shape + ": " + std::string(response.status().message()));
    Json failure = {{"shape", shape}};
    failure.update(ErrorToJson(response.status()));
    failures.push_back(std::move(failure));
  }
  const bool ok = failures.empty();
  if (session.options.json) {
    session.Print(
        {{"deleted", std::move(deleted)}, {"failures", std::move(failures)}});
  } else {
    session.out << absl::StrFormat("%d shapes deleted\n", deleted.size());
  }
  return ok ? kExitOk : kExitFailed;
}

absl::StatusOr<int> DeleteCollection(const Session& session, Client& client,
                                     const DeleteArguments& arguments) {
  v1::DeleteCollectionRequest request;
  request.set_name(CollectionName(arguments.collection));
  request.set_force(arguments.force);
  ARGMESH_RETURN_IF_ERROR(client.DeleteCollection(request));
  if (session.options.json) {
    session.Print({{"deleted_collection", arguments.collection}});
  } else {
    session.out << "collection " << arguments.collection << " deleted\n";
  }
  return kExitOk;
}

}  // namespace

void AddDeleteCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<DeleteArguments>();
  CLI::App* command = commands.Add(
      app, {"delete", "Remove shapes or a collection.", kDeleteDetails},
      [arguments](const Session& session) -> absl::StatusOr<int> {
        ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
        return arguments->shapes.empty()
                   ? DeleteCollection(session, *client, *arguments)
                   : DeleteShapes(session, *client, *arguments);
      });
  AddCollectionOption(command, arguments->collection);
  command->add_flag("--force", arguments->force,
                    "Remove a collection with its shapes");
  command->add_option("ID", arguments->shapes, "Ids of shapes")->type_name("");
}

}  // namespace argmesh
