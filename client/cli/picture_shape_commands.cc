// Pictures of one shape: levels, modes, a coloured mesh file.
#include <memory>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "client/cli/labelled_mesh.h"
#include "client/cli/mesh_files.h"
#include "client/cli/picture_commands.h"
#include "client/cli/search_options.h"
#include "client/picture/figure_shapes.h"
#include "client/picture/palette.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_write.h"

namespace argmesh {
namespace {

constexpr char kLevelsDetails[] =
    R"(One panel a level, coarse to fine, then the uniform cells; each component has a
colour of its own.

Example:
  argmesh picture levels --collection parts valve-7 --out levels.png)";

constexpr char kModesDetails[] =
    R"(Each mode of the mean shift is a dot, its largest stable window a circle around
it. Windows are drawn in units of the square root of the area; of collections by
biharmonic distance they are measured in its joint space and show size only
against each other.

Example:
  argmesh picture modes --collection parts valve-7 --out modes.png)";

constexpr char kPlyDetails[] =
    R"(Colours the mesh of ID by the components of --level (the finest when not given),
or by what corresponds to the shape or file of --match; --match-out then writes
the other side in the same colours.

Examples:
  argmesh picture ply --collection parts valve-7 --level count-16 --out v.ply
  argmesh picture ply --collection parts a --match b --out a.ply --match-out b.ply)";

struct ShapeArguments {
  std::string collection;
  std::string shape;
  std::string level;
  PictureArguments picture;
};

void AddShapeOptions(CLI::App* command, ShapeArguments& arguments) {
  AddCollectionOption(command, arguments.collection);
  AddPictureOptions(command, arguments.picture);
  command->add_option("ID", arguments.shape, "Id of the shape")
      ->required()
      ->type_name("");
}

absl::StatusOr<int> DrawLevels(const Session& session,
                               const ShapeArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(
      const LabelledMesh shape,
      FetchLabelledMesh(*client, arguments.collection, arguments.shape));
  int only = -1;
  if (!arguments.level.empty()) {
    ARGMESH_ASSIGN_OR_RETURN(only, FindLevel(shape.graph, arguments.level));
  }
  const auto levels = LevelsOf(shape.graph);
  std::vector<LevelPanel> panels;
  for (int i = 0; i < static_cast<int>(levels.size()); ++i) {
    if (only >= 0 && i != only) continue;
    const v1::GraphLevel& level = *levels[static_cast<size_t>(i)];
    LevelPanel panel;
    ARGMESH_ASSIGN_OR_RETURN(panel.component_of_face,
                             ComponentsOfFaces(shape, i));
    panel.caption =
        absl::StrFormat("%s: %d components", level.name(), level.nodes_size());
    panels.push_back(std::move(panel));
  }
  FigureOptions options = FigureOptionsOf(arguments.picture);
  options.columns = 4;
  ARGMESH_ASSIGN_OR_RETURN(const Figure figure,
                           RenderLevels(shape.mesh, panels, options));
  return WriteFigure(session, figure, arguments.picture);
}

absl::StatusOr<int> DrawModes(const Session& session,
                              const ShapeArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  const std::string name = ShapeName(arguments.collection, arguments.shape);
  ARGMESH_ASSIGN_OR_RETURN(const ShapeGraphWithLabels answer,
                           client->GetShapeGraph(name));
  ARGMESH_ASSIGN_OR_RETURN(const TriangleMesh mesh, FetchMesh(*client, name));
  const v1::ShapeGraph& graph = answer.graph;
  if (!(graph.scale() > 0)) return absl::DataLossError("a graph without scale");
  const Eigen::Vector3d centroid(graph.centroid().x(), graph.centroid().y(),
                                 graph.centroid().z());
  std::vector<SurfaceMarker> markers;
  for (const v1::GraphMode& mode : graph.modes()) {
    SurfaceMarker marker;
    marker.position =
        centroid + Eigen::Vector3d(mode.position().x(), mode.position().y(),
                                   mode.position().z()) /
                       graph.scale();
    marker.window = static_cast<double>(mode.window()) / graph.scale();
    markers.push_back(marker);
  }
  ARGMESH_ASSIGN_OR_RETURN(const Figure figure,
                           RenderModes(mesh, std::move(markers),
                                       FigureOptionsOf(arguments.picture)));
  return WriteFigure(session, figure, arguments.picture);
}

struct PlyArguments {
  ShapeArguments shape;
  MatchArguments match;
  std::string other;  // empty: colours of a level
  std::string other_out;
};

absl::Status WritePly(const std::string& path, const TriangleMesh& mesh,
                      std::span<const int32_t> labels) {
  return WriteFile(path, SerializeColoredPly(mesh, ColorsOfLabels(labels)));
}

absl::Status WriteMatchPly(Client& client, const PlyArguments& arguments) {
  const std::string& collection = arguments.match.collection;
  v1::CompareShapesRequest request;
  request.set_parent(CollectionName(collection));
  ARGMESH_ASSIGN_OR_RETURN(
      *request.mutable_query(),
      MakeShapeReference(collection, arguments.shape.shape));
  ARGMESH_ASSIGN_OR_RETURN(*request.mutable_target(),
                           MakeShapeReference(collection, arguments.other));
  request.set_mode(ModeOf(arguments.match));
  *request.mutable_parameters() = ParametersOf(arguments.match);
  request.set_return_graphs(true);
  ARGMESH_ASSIGN_OR_RETURN(const MatchedMeshes matched,
                           FetchMatch(client, request));
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<int32_t> query,
                           PairsOfFaces(matched, true));
  ARGMESH_RETURN_IF_ERROR(
      WritePly(arguments.shape.picture.out, matched.query.mesh, query));
  if (arguments.other_out.empty()) return absl::OkStatus();
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<int32_t> target,
                           PairsOfFaces(matched, false));
  return WritePly(arguments.other_out, matched.target.mesh, target);
}

absl::Status WriteLevelPly(Client& client, const PlyArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const LabelledMesh shape,
                           FetchLabelledMesh(client, arguments.match.collection,
                                             arguments.shape.shape));
  int level = shape.graph.levels_size() - 1;
  if (!arguments.shape.level.empty()) {
    ARGMESH_ASSIGN_OR_RETURN(level,
                             FindLevel(shape.graph, arguments.shape.level));
  }
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<int32_t> components,
                           ComponentsOfFaces(shape, level));
  return WritePly(arguments.shape.picture.out, shape.mesh, components);
}

absl::StatusOr<int> WritePlyFiles(const Session& session,
                                  const PlyArguments& arguments) {
  if (arguments.other.empty() && !arguments.other_out.empty()) {
    return UsageError("--match-out needs --match");
  }
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_RETURN_IF_ERROR(arguments.other.empty()
                              ? WriteLevelPly(*client, arguments)
                              : WriteMatchPly(*client, arguments));
  if (session.options.json) {
    Json json = {{"out", arguments.shape.picture.out}};
    if (!arguments.other_out.empty()) json["match_out"] = arguments.other_out;
    session.Print(json);
  } else {
    session.out << arguments.shape.picture.out << '\n';
    if (!arguments.other_out.empty()) {
      session.out << arguments.other_out << '\n';
    }
  }
  return kExitOk;
}

}  // namespace

void AddPictureLevelsCommand(CLI::App& group, CommandSet& commands) {
  const auto arguments = std::make_shared<ShapeArguments>();
  CLI::App* command = commands.Add(
      group,
      {"levels", "The components of a shape at each level.", kLevelsDetails},
      [arguments](const Session& session) {
        return DrawLevels(session, *arguments);
      });
  AddShapeOptions(command, *arguments);
  command->add_option("--level", arguments->level, "Only this level")
      ->type_name("NAME");
}

void AddPictureModesCommand(CLI::App& group, CommandSet& commands) {
  const auto arguments = std::make_shared<ShapeArguments>();
  CLI::App* command = commands.Add(
      group,
      {"modes", "The modes of a surface and their windows.", kModesDetails},
      [arguments](const Session& session) {
        return DrawModes(session, *arguments);
      });
  AddShapeOptions(command, *arguments);
}

void AddPicturePlyCommand(CLI::App& group, CommandSet& commands) {
  const auto arguments = std::make_shared<PlyArguments>();
  CLI::App* command = commands.Add(
      group, {"ply", "A coloured PLY mesh of a level or a match.", kPlyDetails},
      [arguments](const Session& session) {
        return WritePlyFiles(session, *arguments);
      });
  AddMatchOptions(command, arguments->match);
  command->add_option("--out,-o", arguments->shape.picture.out, "PLY file")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--level", arguments->shape.level, "Colours of this level")
      ->type_name("NAME");
  command->add_option("--match", arguments->other, "Colours of this match")
      ->type_name("ID|FILE");
  command->add_option("--match-out", arguments->other_out, "Its PLY file")
      ->type_name("FILE");
  command->add_option("ID", arguments->shape.shape, "Id of the shape")
      ->required()
      ->type_name("");
}

}  // namespace argmesh
