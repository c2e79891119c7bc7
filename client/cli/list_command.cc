#include <memory>

#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/cli/search_options.h"
#include "client/cli/text_table.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kListDetails[] =
    R"(Without --collection the collections are listed, with it its shapes; by id, all
of them unless --limit is given.

Examples:
  argmesh list
  argmesh list --collection parts --limit 20
  argmesh list --collection parts --filter 'mass < 2 AND NOT class = cup'
  argmesh list --collection parts --json)";

struct ListArguments {
  std::string collection;
  std::string filter;  // of the shapes
  int64_t limit = 0;   // 0: all
};

absl::StatusOr<int> ListCollections(const Session& session, Client& client,
                                    int64_t limit) {
  Json json = Json::array();
  TextTable table({"collection", ">shapes", "decomposition", ">generation"});
  int64_t count = 0;
  ARGMESH_RETURN_IF_ERROR(
      client.ForEachCollection([&](const v1::Collection& collection) {
        json.push_back(ToJson(collection));
        table.AddRow({ResourceId(collection.name()),
                      std::to_string(collection.shape_count()),
                      DecompositionName(collection.settings().decomposition()),
                      std::to_string(collection.generation())});
        return ++count != limit;
      }));
  if (session.options.json) {
    session.Print({{"collections", std::move(json)}});
  } else {
    session.out << table.ToString();
  }
  return kExitOk;
}

absl::StatusOr<int> ListShapes(const Session& session, Client& client,
                               const ListArguments& arguments) {
  Json json = Json::array();
  TextTable table(
      {"shape", "class", "format", ">vertices", ">faces", "source"});
  int64_t count = 0;
  ARGMESH_RETURN_IF_ERROR(client.ForEachShape(
      CollectionName(arguments.collection),
      [&](const v1::Shape& shape) {
        if (session.options.json) {
          json.push_back(ToJson(shape));
        } else {
          const v1::MeshReport& report = shape.mesh().report();
          table.AddRow({ResourceId(shape.name()), ClassOf(shape),
                        FormatName(shape.mesh().format()),
                        std::to_string(report.vertices()),
                        std::to_string(report.faces()), shape.source_uri()});
        }
        return ++count != arguments.limit;
      },
      arguments.filter));
  if (session.options.json) {
    session.Print(
        {{"collection", arguments.collection}, {"shapes", std::move(json)}});
  } else {
    session.out << table.ToString();
  }
  return kExitOk;
}

}  // namespace

void AddListCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<ListArguments>();
  CLI::App* command = commands.Add(
      app, {"list", "List collections, or the shapes of one.", kListDetails},
      [arguments](const Session& session) -> absl::StatusOr<int> {
        if (arguments->collection.empty() && !arguments->filter.empty()) {
          return UsageError("--filter needs --collection");
        }
        ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
        return arguments->collection.empty()
                   ? ListCollections(session, *client, arguments->limit)
                   : ListShapes(session, *client, *arguments);
      });
  AddCollectionOption(command, arguments->collection)->required(false);
  AddFilterOption(command, arguments->filter);
  command->add_option("--limit", arguments->limit, "At most so many; 0: all")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace argmesh
