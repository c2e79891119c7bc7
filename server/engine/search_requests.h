// What a search and a comparison take and give.
#ifndef ARGMESH_SERVER_ENGINE_SEARCH_REQUESTS_H_
#define ARGMESH_SERVER_ENGINE_SEARCH_REQUESTS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "absl/time/time.h"
#include "core/containment/containment_match.h"
#include "core/graph/shape_graph.h"
#include "core/matching/match.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_report.h"
#include "core/signature/signature_similarity.h"
#include "server/engine/shape_record.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

enum class MatchMode { kGlobal, kPartial };

// kFused: graphs and signatures globally, windows of the surface partially.
// kGraph: the graphs alone, the paper's score.
enum class RankingMethod { kFused, kGraph };

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
  // Finest components of a ShapeRef: the query is that part of it.
  std::vector<int32_t> region_nodes;
  AttributeSet attributes = AttributeSet::kFull;  // kGlobal only
  std::vector<std::string> levels;  // as MatchOptions; kFieldInvalid: no such
  // A ShapeGraph as the query is always ranked by graphs.
  RankingMethod ranking = RankingMethod::kFused;
  bool rerank = false;            // kFused only
  int candidates = 0;             // of the first stage, >= 0; 0: as many as pay
  bool exact = false;             // every shape is a candidate
  int limit = 10;                 // 1 .. 1000
  double min_score = 0;           // 0 .. 1
  double min_query_coverage = 0;  // 0 .. 1
  bool exclude_query = false;     // leave a stored query out of its answer
  bool correspondence = true;     // fill MatchResult::pairs
  bool query_graph = false;       // fill SearchAnswer::query_graph
  std::string filter;             // MetadataFilter; empty: all shapes
  int64_t min_generation = 0;     // refuse to answer from an older state
};

// One summand of a score: value * weight.
struct ScoreTerm {
  std::string name;
  double value = 0;
  double weight = 0;
};

struct SearchMatch {
  ShapeRecord shape;
  double score = 0;              // 0 .. 1, what the answer is ranked by
  MatchResult match;             // of the graphs
  std::vector<ScoreTerm> terms;  // of a fused score; their sum is `score`
  int32_t candidate_rank = 0;    // in the first stage; 0: there was none
  Handedness handedness = Handedness::kUndecided;
  std::optional<ContainmentMatch> containment;  // kFused and kPartial
  bool tied = false;                            // as RankedContainment
};

struct StageTime {
  std::string stage;
  absl::Duration elapsed;
};

struct SearchStats {
  int64_t generation = 0;  // of the collection that was searched
  int64_t shapes_considered = 0;
  int64_t shapes_matched = 0;     // beyond the first stage
  int64_t shapes_unusable = 0;    // stored, but damaged or of another version
  bool exhaustive = true;         // every stored shape was matched
  std::vector<StageTime> stages;  // in order
};

// The graph of a query, and what it was made from when that was a mesh.
struct QueryGraph {
  ShapeGraph graph;
  FaceLabels labels;
  MeshReport report;
};

struct SearchAnswer {
  // By score, descending, then by id, unless they were reranked.
  std::vector<SearchMatch> matches;
  bool query_generic = false;  // kPartial: too few features to say where
  SearchStats stats;
  std::optional<QueryGraph> query_graph;
};

struct CompareQuery {
  QueryShape a;
  QueryShape b;
  MatchMode mode = MatchMode::kGlobal;
  AttributeSet attributes = AttributeSet::kFull;  // kGlobal only
  std::vector<std::string> levels;  // as MatchOptions; kFieldInvalid: no such
  RankingMethod ranking = RankingMethod::kFused;
  std::string collection;  // whose settings turn meshes into graphs
  bool graphs = false;     // fill ComparedShapes::a and b
};

struct ComparedShapes {
  SearchMatch match;  // without its shape's record
  std::optional<QueryGraph> a;
  std::optional<QueryGraph> b;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SEARCH_REQUESTS_H_
