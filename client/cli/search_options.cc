#include "client/cli/search_options.h"

#include <filesystem>
#include <system_error>

#include "absl/strings/str_split.h"
#include "client/cli/query_mesh.h"
#include "client/cli/session.h"
#include "client/resource_name.h"
#include "core/base/identifier.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

absl::Status CheckShapeId(const std::string& id) {
  const absl::Status status = CheckIdentifier("shape", id);
  return status.ok() ? status : UsageError(std::string(status.message()));
}

}  // namespace

void AddMatchOptions(CLI::App* command, MatchArguments& arguments) {
  command
      ->add_option("--collection,-c", arguments.collection,
                   "Id of the collection")
      ->required()
      ->type_name("ID");
  command
      ->add_option("--mode,-m", arguments.mode,
                   "global: alike as a whole; partial: has the query as a part")
      ->type_name("MODE")
      ->check(CLI::IsMember({"global", "partial"}))
      ->capture_default_str();
  command
      ->add_option("--attributes", arguments.attributes,
                   "Attributes that count: full or tuple")
      ->type_name("SET")
      ->check(CLI::IsMember({"full", "tuple"}));
  command
      ->add_option("--levels", arguments.levels,
                   "Levels that count, names with commas, as `argmesh graph` "
                   "shows them")
      ->type_name("NAMES");
  command
      ->add_option("--ranking", arguments.ranking,
                   "fused: graphs with signatures or windows of the surface "
                   "(the default); graph: the graphs alone")
      ->type_name("METHOD")
      ->check(CLI::IsMember({"fused", "graph"}));
}

void AddRerankOption(CLI::App* command, bool& rerank) {
  command->add_flag(
      "--rerank", rerank,
      "Order the answer by how alike its shapes are to each other, too");
}

void AddFilterOption(CLI::App* command, std::string& filter) {
  command
      ->add_option("--filter", filter,
                   "Only shapes whose metadata it holds for, such as "
                   "'class = cup AND mass < 2'; of keys that `argmesh declare` "
                   "declared")
      ->type_name("FILTER");
}

v1::SearchMode ModeOf(const MatchArguments& arguments) {
  return arguments.mode == "partial" ? v1::SEARCH_MODE_PARTIAL
                                     : v1::SEARCH_MODE_GLOBAL;
}

v1::MatchParameters ParametersOf(const MatchArguments& arguments) {
  v1::MatchParameters parameters;
  if (arguments.attributes == "full") {
    parameters.set_attributes(v1::ATTRIBUTE_SET_FULL);
  } else if (arguments.attributes == "tuple") {
    parameters.set_attributes(v1::ATTRIBUTE_SET_TUPLE);
  }
  if (arguments.ranking == "fused") {
    parameters.set_ranking(v1::RANKING_METHOD_FUSED);
  } else if (arguments.ranking == "graph") {
    parameters.set_ranking(v1::RANKING_METHOD_GRAPH);
  }
  for (const auto& name :
       absl::StrSplit(arguments.levels, ',', absl::SkipEmpty())) {
    parameters.add_levels(std::string(name));
  }
  return parameters;
}

void AddSearchOptions(CLI::App* command, SearchArguments& arguments) {
  AddMatchOptions(command, arguments.match);
  command->add_option("--limit,-k", arguments.limit, "At most so many matches")
      ->type_name("K")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--min-score", arguments.min_score,
                   "Only matches that score at least this")
      ->type_name("0..1")
      ->check(CLI::Range(0.0, 1.0));
  command
      ->add_option("--min-coverage", arguments.min_query_coverage,
                   "Only matches that cover this share of the query's area")
      ->type_name("0..1")
      ->check(CLI::Range(0.0, 1.0));
  AddFilterOption(command, arguments.filter);
  command->add_flag("--include-self", arguments.include_self,
                    "Leave the shape of --shape in its own answer (default: "
                    "it is left out)");
  command->add_option("--shape", arguments.shape, "The query: a stored shape")
      ->type_name("ID");
  command
      ->add_option("--region", arguments.region,
                   "Components of --shape that are the query, numbers with "
                   "commas, as `argmesh graph` shows its finest level")
      ->type_name("NODES")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber);
  AddRerankOption(command, arguments.rerank);
  command->add_option("FILE", arguments.file, "The query: a mesh file")
      ->type_name("");
}

absl::StatusOr<v1::SearchShapesRequest> MakeSearchRequest(
    const SearchArguments& arguments) {
  if (arguments.shape.empty() == arguments.file.empty()) {
    return UsageError("one query is needed: --shape ID or a mesh FILE");
  }
  if (!arguments.region.empty() && arguments.shape.empty()) {
    return UsageError("--region needs --shape");
  }
  const std::string& collection = arguments.match.collection;
  v1::SearchShapesRequest request;
  request.set_parent(CollectionName(collection));
  if (!arguments.shape.empty()) {
    ARGMESH_RETURN_IF_ERROR(CheckShapeId(arguments.shape));
    request.set_shape(ShapeName(collection, arguments.shape));
    request.set_exclude_query(!arguments.include_self);
  } else {
    ARGMESH_ASSIGN_OR_RETURN(*request.mutable_mesh(),
                             ReadQueryMesh(arguments.file));
  }
  request.mutable_region_node_ids()->Add(arguments.region.begin(),
                                         arguments.region.end());
  request.set_mode(ModeOf(arguments.match));
  request.set_limit(arguments.limit);
  request.set_min_score(arguments.min_score);
  request.set_min_query_coverage(arguments.min_query_coverage);
  request.set_filter(arguments.filter);
  request.set_explain(arguments.explain);
  *request.mutable_parameters() = ParametersOf(arguments.match);
  request.mutable_parameters()->set_rerank(arguments.rerank);
  return request;
}

absl::StatusOr<v1::ShapeReference> MakeShapeReference(
    const std::string& collection, const std::string& id_or_file) {
  v1::ShapeReference reference;
  std::error_code error;
  if (std::filesystem::is_regular_file(id_or_file, error)) {
    ARGMESH_ASSIGN_OR_RETURN(*reference.mutable_mesh(),
                             ReadInlineMesh(id_or_file));
    return reference;
  }
  if (!IsIdentifier(id_or_file)) {
    return UsageError(id_or_file + ": neither a file nor a shape id");
  }
  reference.set_shape(ShapeName(collection, id_or_file));
  return reference;
}

}  // namespace argmesh
