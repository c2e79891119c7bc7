#include <memory>

#include "absl/strings/str_format.h"
#include "client/cli/command_set.h"
#include "client/cli/labelled_mesh.h"
#include "client/cli/text_table.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kGraphDetails[] =
    R"(Shows the levels of the graph, coarse to fine; with --level the components of
that level and which of them are neighbours. --json has all attributes.

Examples:
  argmesh graph --collection parts valve-7
  argmesh graph --collection parts valve-7 --level count-16)";

struct GraphArguments {
  std::string collection;
  std::string shape;
  std::string level;
};

std::string LevelsTable(const v1::ShapeGraph& graph) {
  TextTable table({"level", ">components", ">neighbours", ">threshold"});
  for (const v1::GraphLevel* level : LevelsOf(graph)) {
    table.AddRow(
        {level->name(), std::to_string(level->nodes_size()),
         std::to_string(level->edges_size()),
         level->threshold() > 0 ? FormatNumber(level->threshold(), 3) : ""});
  }
  return table.ToString();
}

std::string LevelTables(const v1::GraphLevel& level) {
  TextTable nodes({">node", ">parent", ">area", ">normals", ">gauss sd",
                   ">gauss", ">mean sd", ">mean", ">geodesic sd", ">geodesic"});
  for (int i = 0; i < level.nodes_size(); ++i) {
    const v1::GraphNode& node = level.nodes(i);
    nodes.AddRow({std::to_string(i),
                  node.parent() < 0 ? "" : std::to_string(node.parent()),
                  FormatNumber(100 * static_cast<double>(node.area()), 1) + "%",
                  FormatNumber(node.normal_deviation(), 3),
                  FormatNumber(node.gauss_deviation(), 3),
                  FormatNumber(node.gauss_mean(), 3),
                  FormatNumber(node.mean_deviation(), 3),
                  FormatNumber(node.mean_mean(), 3),
                  FormatNumber(node.geodesic_deviation(), 3),
                  FormatNumber(node.geodesic_mean(), 3)});
  }
  TextTable edges({">a", ">b", ">geodesic", ">border"});
  for (const v1::GraphEdge& edge : level.edges()) {
    edges.AddRow({std::to_string(edge.a()), std::to_string(edge.b()),
                  FormatNumber(edge.geodesic(), 3),
                  FormatNumber(edge.border_length(), 3)});
  }
  return nodes.ToString() + "\n" + edges.ToString();
}

absl::StatusOr<int> ShowGraph(const Session& session,
                              const GraphArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(
      const ShapeGraphWithLabels answer,
      client->GetShapeGraph(ShapeName(arguments.collection, arguments.shape)));
  const v1::GraphLevel* chosen = nullptr;
  if (!arguments.level.empty()) {
    ARGMESH_ASSIGN_OR_RETURN(const int level,
                             FindLevel(answer.graph, arguments.level));
    chosen = LevelsOf(answer.graph)[static_cast<size_t>(level)];
  }
  if (session.options.json) {
    Json json = {{"shape", arguments.shape}};
    json.update(ToJson(answer.graph, arguments.level));
    session.Print(json);
  } else if (chosen != nullptr) {
    session.out << LevelTables(*chosen);
  } else {
    session.out << LevelsTable(answer.graph)
                << absl::StrFormat("%d modes, %d connected pieces\n",
                                   answer.graph.modes_size(),
                                   answer.graph.connected_components());
  }
  return kExitOk;
}

}  // namespace

void AddGraphCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<GraphArguments>();
  CLI::App* command =
      commands.Add(app,
                   {"graph", "Show the attributed relational graph of a shape.",
                    kGraphDetails},
                   [arguments](const Session& session) {
                     return ShowGraph(session, *arguments);
                   });
  AddCollectionOption(command, arguments->collection);
  command->add_option("--level", arguments->level, "Only this level")
      ->type_name("NAME");
  command->add_option("ID", arguments->shape, "Id of the shape")
      ->required()
      ->type_name("");
}

}  // namespace argmesh
