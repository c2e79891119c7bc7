// What a search and a comparison take and give.
#ifndef ARGMESH_SERVER_ENGINE_SEARCH_REQUESTS_H_
#define ARGMESH_SERVER_ENGINE_SEARCH_REQUESTS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "absl/time/time.h"
#include "core/graph/shape_graph.h"
#include "core/matching/match.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_report.h"
#include "server/engine/shape_record.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

enum class MatchMode { kGlobal, kPartial };

struct MeshBytes {
  std::string bytes;
  MeshFormat format = MeshFormat::kUnknown;
};

// A stored shape, a mesh, or a graph made before.
using QueryShape = std::variant<ShapeRef, MeshBytes, ShapeGraph>;

struct SearchQuery {
  std::string collection;
  // A ShapeRef may be of another collection with equal settings.
  QueryShape query;
  MatchMode mode = MatchMode::kGlobal;
  AttributeSet attributes = AttributeSet::kFull;  // kGlobal only
  int limit = 10;                                 // 1 .. 1000
  double min_score = 0;                           // 0 .. 1
  double min_query_coverage = 0;                  // 0 .. 1
  bool exclude_query = false;  // leave a stored query out of its answer
  bool correspondence = true;  // fill MatchResult::pairs
  bool query_graph = false;    // fill SearchAnswer::query_graph
  int64_t min_generation = 0;  // refuse to answer from an older state
};

struct SearchMatch {
  ShapeRecord shape;
  MatchResult match;
};

struct SearchStats {
  int64_t generation = 0;  // of the collection that was searched
  int64_t shapes_considered = 0;
  int64_t shapes_matched = 0;   // by their graphs
  int64_t shapes_unusable = 0;  // stored, but damaged or of another version
  bool exhaustive = true;       // every stored shape was matched
  absl::Duration query_time;    // parse and abstraction, or look-up
  absl::Duration match_time;
  absl::Duration correspondence_time;
};

// The graph of a query, and what it was made from when that was a mesh.
struct QueryGraph {
  ShapeGraph graph;
  FaceLabels labels;
  MeshReport report;
};

struct SearchAnswer {
  std::vector<SearchMatch> matches;  // by score, descending, then by id
  SearchStats stats;
  std::optional<QueryGraph> query_graph;
};

struct CompareQuery {
  QueryShape a;
  QueryShape b;
  MatchMode mode = MatchMode::kGlobal;
  AttributeSet attributes = AttributeSet::kFull;  // kGlobal only
  std::string collection;  // whose settings turn meshes into graphs
  bool graphs = false;     // fill ComparedShapes::a and b
};

struct ComparedShapes {
  MatchResult match;
  std::optional<QueryGraph> a;
  std::optional<QueryGraph> b;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SEARCH_REQUESTS_H_
