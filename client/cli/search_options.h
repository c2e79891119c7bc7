// Options that searching commands share, and the requests made from them.
#ifndef ARGMESH_CLIENT_CLI_SEARCH_OPTIONS_H_
#define ARGMESH_CLIENT_CLI_SEARCH_OPTIONS_H_

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "argmesh/v1/match.pb.h"
#include "argmesh/v1/search_service.pb.h"

namespace argmesh {

struct MatchArguments {
  std::string collection;
  std::string mode = "global";
  std::string attributes;  // "full", "tuple"; empty: the server's choice
  std::string levels;      // names with commas; empty: the server's choice
  std::string ranking;     // "fused", "graph"; empty: the server's choice
};

// --collection, --mode, --attributes, --levels, --ranking.
void AddMatchOptions(CLI::App* command, MatchArguments& arguments);

// --rerank
void AddRerankOption(CLI::App* command, bool& rerank);

v1::SearchMode ModeOf(const MatchArguments& arguments);
v1::MatchParameters ParametersOf(const MatchArguments& arguments);

// One query of a collection: a stored shape or a mesh file.
struct SearchArguments {
  MatchArguments match;
  std::string shape;  // id; or
  std::string file;
  std::vector<int32_t> region;  // components of the shape
  bool rerank = false;
  int limit = 10;
  double min_score = 0;
  double min_query_coverage = 0;
  bool include_self = false;
  std::string filter;  // over metadata; empty: all shapes
  bool explain = false;
};

// --filter, as docs/api.md has it.
void AddFilterOption(CLI::App* command, std::string& filter);

// AddMatchOptions, AddFilterOption, --shape, FILE, --limit, --min-score,
// --min-coverage,
// --include-self, --region, --rerank.
void AddSearchOptions(CLI::App* command, SearchArguments& arguments);

// Reads the query file. A usage error unless there is one query.
absl::StatusOr<v1::SearchShapesRequest> MakeSearchRequest(
    const SearchArguments& arguments);

// A stored shape's id or, where there is a file of that name, the file.
absl::StatusOr<v1::ShapeReference> MakeShapeReference(
    const std::string& collection, const std::string& id_or_file);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_SEARCH_OPTIONS_H_
