#include <memory>

#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/cli/mesh_files.h"
#include "client/cli/text_table.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kGetDetails[] = R"(Without ID the collection itself is shown.

Examples:
  argmesh get --collection parts
  argmesh get --collection parts valve-7 --json
  argmesh get --collection parts valve-7 --out valve-7.off)";

struct GetArguments {
  std::string collection;
  std::string shape;
  std::string out;
};

// Nested values as "mesh.report.faces"; lists as JSON.
void AddRows(const std::string& prefix, const Json& json, TextTable& table) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_object()) {
      AddRows(prefix + key + ".", value, table);
    } else {
      table.AddRow({prefix + key, value.is_string() ? value.get<std::string>()
                                                    : value.dump()});
    }
  }
}

void PrintDocument(const Session& session, const Json& json) {
  if (session.options.json) {
    session.Print(json);
    return;
  }
  TextTable table({"field", "value"});
  AddRows("", json, table);
  session.out << table.ToString();
}

absl::StatusOr<int> GetShape(const Session& session, Client& client,
                             const GetArguments& arguments) {
  const std::string name = ShapeName(arguments.collection, arguments.shape);
  ARGMESH_ASSIGN_OR_RETURN(const v1::Shape shape, client.GetShape(name));
  Json json = ToJson(shape);
  if (!arguments.out.empty()) {
    ARGMESH_ASSIGN_OR_RETURN(const DownloadedMesh mesh,
                             client.DownloadMesh(name));
    ARGMESH_RETURN_IF_ERROR(WriteFile(arguments.out, mesh.bytes));
    json["out"] = arguments.out;
  }
  PrintDocument(session, json);
  return kExitOk;
}

}  // namespace

void AddGetCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<GetArguments>();
  CLI::App* command = commands.Add(
      app, {"get", "Show a shape or a collection, fetch a mesh.", kGetDetails},
      [arguments](const Session& session) -> absl::StatusOr<int> {
        ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
        if (!arguments->shape.empty()) {
          return GetShape(session, *client, *arguments);
        }
        if (!arguments->out.empty()) return UsageError("--out needs an ID");
        ARGMESH_ASSIGN_OR_RETURN(
            const v1::Collection collection,
            client->GetCollection(CollectionName(arguments->collection)));
        PrintDocument(session, ToJson(collection));
        return kExitOk;
      });
  AddCollectionOption(command, arguments->collection);
  command->add_option("--out,-o", arguments->out, "Write the mesh file here")
      ->type_name("FILE");
  command->add_option("ID", arguments->shape, "Id of the shape")->type_name("");
}

}  // namespace argmesh
