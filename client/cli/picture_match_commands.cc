// Pictures of several shapes: a match, ranked results, a matrix of classes.
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "client/cli/evaluation_run.h"
#include "client/cli/labelled_mesh.h"
#include "client/cli/mesh_files.h"
#include "client/cli/picture_commands.h"
#include "client/cli/search_options.h"
#include "client/picture/figure_matrix.h"
#include "client/picture/figure_shapes.h"
#include "client/picture/palette.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kMatchDetails[] =
    R"(Corresponding components of A and B have equal colours; what has no counterpart
is grey. A and B are ids of stored shapes or mesh files.

Example:
  argmesh picture match --collection parts valve-7 valve-9 --out match.png)";

constexpr char kResultsDetails[] =
    R"(The query and what a search finds for it, best first. Frames are green for the
query's class and red for others; there are none when its class is not known.

Examples:
  argmesh picture results --collection parts --shape valve-7 --out found.png
  argmesh picture results --collection parts --mode partial piece.obj --out p.png)";

constexpr char kMatrixDetails[] =
    R"(Mean scores of the classes against each other: computed now, or those of an
earlier `argmesh evaluate --json` by --from.

Examples:
  argmesh picture matrix --collection parts --out matrix.png
  argmesh picture matrix --from evaluation.json --out matrix.png)";

struct MatchPictureArguments {
  MatchArguments match;
  std::string a;
  std::string b;
  PictureArguments picture;
};

absl::StatusOr<int> DrawMatch(const Session& session,
                              const MatchPictureArguments& arguments) {
  const std::string& collection = arguments.match.collection;
  v1::CompareShapesRequest request;
  request.set_parent(CollectionName(collection));
  ARGMESH_ASSIGN_OR_RETURN(*request.mutable_query(),
                           MakeShapeReference(collection, arguments.a));
  ARGMESH_ASSIGN_OR_RETURN(*request.mutable_target(),
                           MakeShapeReference(collection, arguments.b));
  request.set_mode(ModeOf(arguments.match));
  *request.mutable_parameters() = ParametersOf(arguments.match);
  request.set_return_graphs(true);
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const MatchedMeshes matched,
                           FetchMatch(*client, request));
  PairSide left{&matched.query.mesh, {}, arguments.a};
  PairSide right{&matched.target.mesh, {}, arguments.b};
  ARGMESH_ASSIGN_OR_RETURN(left.match_of_face, PairsOfFaces(matched, true));
  ARGMESH_ASSIGN_OR_RETURN(right.match_of_face, PairsOfFaces(matched, false));
  FigureOptions options = FigureOptionsOf(arguments.picture);
  if (options.title.empty()) {
    options.title = absl::StrFormat("%s, score %.3f, %d pairs at %s",
                                    arguments.match.mode, matched.match.score(),
                                    matched.match.component_pairs_size(),
                                    matched.match.best_level());
  }
  ARGMESH_ASSIGN_OR_RETURN(const Figure figure,
                           RenderPair(left, right, options));
  return WriteFigure(session, figure, arguments.picture);
}

struct ResultsArguments {
  SearchArguments search;
  std::string query_class;
  PictureArguments picture;
};

// Panels without frames, for a query whose class is not known.
absl::StatusOr<Figure> DrawUnframed(const TriangleMesh& query,
                                    std::span<const RankedShape> results,
                                    FigureOptions options) {
  options.columns = 6;
  RenderOptions render = options.render;
  render.width = options.panel_width;
  render.height = options.panel_height;
  std::vector<Panel> panels(results.size() + 1);
  ARGMESH_ASSIGN_OR_RETURN(panels[0].image,
                           RenderMesh(query, CategoricalColor(1), render));
  panels[0].caption = "query";
  for (size_t i = 0; i < results.size(); ++i) {
    ARGMESH_ASSIGN_OR_RETURN(panels[i + 1].image,
                             RenderMesh(*results[i].mesh, kPaleGrey, render));
    panels[i + 1].caption = absl::StrFormat(
        "%d. %s %.3f", i + 1, results[i].class_name, results[i].score);
  }
  return Compose(panels, options);
}

// Framed by whether the class is the query's, where that is known.
absl::StatusOr<Figure> DrawRanking(const TriangleMesh& query,
                                   const std::string& query_class,
                                   std::span<const RankedShape> results,
                                   const PictureArguments& picture) {
  FigureOptions options = FigureOptionsOf(picture);
  if (picture.width == 0) {
    options.panel_width = 240;
    options.panel_height = 200;
  }
  if (query_class.empty()) return DrawUnframed(query, results, options);
  return RenderContactSheet(query, "query: " + query_class, results, options);
}

absl::StatusOr<int> DrawResults(const Session& session,
                                const ResultsArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(v1::SearchShapesRequest request,
                           MakeSearchRequest(arguments.search));
  request.set_omit_component_pairs(true);
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const v1::SearchShapesResponse response,
                           client->SearchShapes(request));
  TriangleMesh query;
  std::string query_class = arguments.query_class;
  if (request.has_shape()) {
    ARGMESH_ASSIGN_OR_RETURN(query, FetchMesh(*client, request.shape()));
    ARGMESH_ASSIGN_OR_RETURN(const v1::Shape shape,
                             client->GetShape(request.shape()));
    if (query_class.empty()) query_class = ClassOf(shape);
  } else {
    ARGMESH_ASSIGN_OR_RETURN(query, ReadMesh(request.mesh()));
  }
  std::vector<TriangleMesh> meshes;
  meshes.reserve(static_cast<size_t>(response.matches_size()));
  std::vector<RankedShape> results;
  for (const v1::Match& match : response.matches()) {
    ARGMESH_ASSIGN_OR_RETURN(TriangleMesh mesh,
                             FetchMesh(*client, match.shape().name()));
    meshes.push_back(std::move(mesh));
    const std::string label = ClassOf(match.shape());
    results.push_back(
        {.mesh = &meshes.back(),
         .class_name = label.empty() ? ResourceId(match.shape().name()) : label,
         .score = match.score(),
         .relevant = label == query_class});
  }
  ARGMESH_ASSIGN_OR_RETURN(
      const Figure figure,
      DrawRanking(query, query_class, results, arguments.picture));
  return WriteFigure(session, figure, arguments.picture);
}

struct MatrixArguments {
  EvaluateArguments evaluate;
  std::string from;
  PictureArguments picture;
};

struct NamedMatrix {
  std::vector<std::string> classes;
  std::vector<std::vector<double>> values;
};

absl::StatusOr<NamedMatrix> ReadMatrix(const std::string& path) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string text,
                           ReadFile(path, int64_t{1} << 30));
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  const Json matrix = json.is_object() ? json.value("matrix", Json()) : Json();
  try {
    return NamedMatrix{
        matrix.at("classes").get<std::vector<std::string>>(),
        matrix.at("mean_score").get<std::vector<std::vector<double>>>()};
  } catch (const Json::exception&) {
    return absl::InvalidArgumentError(
        path + ": not the output of `argmesh evaluate --json` with a matrix");
  }
}

absl::StatusOr<NamedMatrix> FindMatrix(const Session& session,
                                       const MatrixArguments& arguments) {
  if (!arguments.from.empty()) return ReadMatrix(arguments.from);
  if (arguments.evaluate.match.collection.empty()) {
    return UsageError("--collection or --from is needed");
  }
  ARGMESH_ASSIGN_OR_RETURN(Evaluation evaluation,
                           RunEvaluation(session, arguments.evaluate));
  return NamedMatrix{std::move(evaluation.classes),
                     std::move(evaluation.matrix)};
}

absl::StatusOr<int> DrawMatrix(const Session& session,
                               const MatrixArguments& arguments) {
  ARGMESH_ASSIGN_OR_RETURN(const NamedMatrix matrix,
                           FindMatrix(session, arguments));
  const auto size = static_cast<Eigen::Index>(matrix.classes.size());
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(
      size, size, std::numeric_limits<double>::quiet_NaN());
  for (size_t i = 0; i < matrix.values.size() && i < matrix.classes.size();
       ++i) {
    for (size_t j = 0; j < matrix.values[i].size() && j < matrix.classes.size();
         ++j) {
      values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          matrix.values[i][j];
    }
  }
  MatrixFigureOptions options;
  options.title = arguments.picture.title;
  if (arguments.picture.width > 0)
    options.cell_pixels = arguments.picture.width;
  ARGMESH_ASSIGN_OR_RETURN(
      const Figure figure,
      RenderMatrix(values, matrix.classes, matrix.classes, options));
  return WriteFigure(session, figure, arguments.picture);
}

}  // namespace

void AddPictureMatchCommand(CLI::App& group, CommandSet& commands) {
  const auto arguments = std::make_shared<MatchPictureArguments>();
  CLI::App* command = commands.Add(
      group,
      {"match", "Two shapes with matched components in equal colours.",
       kMatchDetails},
      [arguments](const Session& session) {
        return DrawMatch(session, *arguments);
      });
  AddMatchOptions(command, arguments->match);
  AddPictureOptions(command, arguments->picture);
  command->add_option("A", arguments->a, "Shape id or mesh file, the query")
      ->required()
      ->type_name("");
  command->add_option("B", arguments->b, "Shape id or mesh file, the target")
      ->required()
      ->type_name("");
}

void AddPictureResultsCommand(CLI::App& group, CommandSet& commands) {
  const auto arguments = std::make_shared<ResultsArguments>();
  CLI::App* command =
      commands.Add(group,
                   {"results", "The query and the best matches of a search.",
                    kResultsDetails},
                   [arguments](const Session& session) {
                     return DrawResults(session, *arguments);
                   });
  AddSearchOptions(command, arguments->search);
  AddPictureOptions(command, arguments->picture);
  command->add_option("--class", arguments->query_class, "Class of the query")
      ->type_name("NAME");
}

void AddPictureMatrixCommand(CLI::App& group, CommandSet& commands) {
  const auto arguments = std::make_shared<MatrixArguments>();
  CLI::App* command = commands.Add(
      group,
      {"matrix", "Mean scores of classes against classes.", kMatrixDetails},
      [arguments](const Session& session) {
        return DrawMatrix(session, *arguments);
      });
  AddMatchOptions(command, arguments->evaluate.match);
  command->get_option("--collection")->required(false);
  command->add_option("--from", arguments->from, "Output of evaluate --json")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  AddPictureOptions(command, arguments->picture);
}

}  // namespace argmesh
