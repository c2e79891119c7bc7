#include "server/engine/shape_search.h"

#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "core/graph/graph_codec.h"
#include "server/engine/error_reason.h"
#include "server/engine/mesh_analysis.h"
#include "server/engine/request_rules.h"

namespace argmesh {
namespace {

// Takes the time since the last call.
class Stopwatch {
 public:
  absl::Duration Lap() {
    const absl::Time now = absl::Now();
    return now - std::exchange(last_, now);
  }

 private:
  absl::Time last_ = absl::Now();
};

RankQuery RankQueryOf(const SearchQuery& query, const MatchableGraph& graph) {
  RankQuery rank{.graph = graph,
                 .mode = query.mode,
                 .attributes = query.attributes,
                 .limit = query.limit,
                 .min_score = query.min_score,
                 .min_query_coverage = query.min_query_coverage,
                 .exclude_id = ""};
  const auto* stored = std::get_if<ShapeRef>(&query.query);
  if (query.exclude_query && stored != nullptr &&
      stored->collection == query.collection) {
    rank.exclude_id = stored->id;
  }
  return rank;
}

}  // namespace

absl::StatusOr<ShapeGraph> ParseStoredGraph(const StoredGraph& stored) {
  const ErrorMetadata which = {{"collection", stored.record.collection},
                               {"shape", stored.record.id}};
  if (stored.graph_version != kShapeGraphVersion) {
    return MakeError(
        ErrorReason::kGraphVersionMismatch,
        absl::StrFormat("the graph of shape %s has version %d, not %d",
                        stored.record.id, stored.graph_version,
                        kShapeGraphVersion),
        which);
  }
  absl::StatusOr<ShapeGraph> graph = ParseShapeGraph(stored.graph);
  if (graph.ok()) return graph;
  return MakeError(ErrorReason::kStoredDataDamaged,
                   absl::StrFormat("shape %s: %s", stored.record.id,
                                   std::string(graph.status().message())),
                   which);
}

ShapeSearch::ShapeSearch(const EngineOptions& options, const Catalog& catalog,
                         const Gallery& gallery, ComputePool& pool)
    : options_(options),
      catalog_(catalog),
      gallery_(gallery),
      pool_(pool),
      ranker_(MakeExactRanker(pool)) {}

absl::StatusOr<QueryGraph> ShapeSearch::ResolveStored(
    const ShapeRef& shape, const CollectionSettings& settings) const {
  ARGMESH_RETURN_IF_ERROR(CheckShapeRef(shape));
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRecord collection,
                           catalog_.GetCollection(shape.collection));
  CollectionSettings compared = collection.settings;
  compared.store_meshes = settings.store_meshes;  // says nothing about graphs
  if (compared != settings) {
    return MakeError(ErrorReason::kGraphVersionMismatch,
                     absl::StrFormat("collection %s has other settings: its "
                                     "graphs cannot be compared",
                                     shape.collection),
                     {{"collection", shape.collection}});
  }
  ARGMESH_ASSIGN_OR_RETURN(
      const StoredGraph stored,
      catalog_.ReadGraph(shape.collection, shape.id, false));
  QueryGraph query;
  query.report = stored.record.report;
  ARGMESH_ASSIGN_OR_RETURN(query.graph, ParseStoredGraph(stored));
  return query;
}

absl::StatusOr<QueryGraph> ShapeSearch::Resolve(
    const QueryShape& shape, const CollectionSettings& settings,
    const StopToken& stop) const {
  if (const auto* stored = std::get_if<ShapeRef>(&shape)) {
    return ResolveStored(*stored, settings);
  }
  if (const auto* mesh = std::get_if<MeshBytes>(&shape)) {
    ARGMESH_ASSIGN_OR_RETURN(
        AnalyzedMesh analyzed,
        AnalyzeMesh(mesh->bytes, mesh->format, settings, options_, stop));
    return QueryGraph{std::move(analyzed.computed.graph),
                      std::move(analyzed.computed.labels),
                      analyzed.computed.report};
  }
  const auto& graph = std::get<ShapeGraph>(shape);
  if (const absl::Status status = CheckShapeGraph(graph); !status.ok()) {
    return MakeError(ErrorReason::kGraphInvalid, std::string(status.message()));
  }
  return QueryGraph{graph, {}, {}};
}

void ShapeSearch::FillMatches(const SearchQuery& query,
                              const MatchableGraph& graph,
                              const Ranking& ranking, const StopToken& stop,
                              std::vector<SearchMatch>& matches) const {
  matches.resize(ranking.shapes.size());
  pool_.ParallelFor(
      WorkClass::kSearch, static_cast<int64_t>(matches.size()), [&](int64_t i) {
        if (!stop.Check().ok()) return;
        const auto at = static_cast<size_t>(i);
        const GalleryEntry& entry = *ranking.shapes[at].entry;
        matches[at].shape = entry.record;
        matches[at].match = MatchGraphs(query.mode, graph, entry.graph,
                                        {.attributes = query.attributes});
        if (!query.correspondence) matches[at].match.pairs.clear();
      });
}

absl::StatusOr<SearchAnswer> ShapeSearch::Search(const SearchQuery& query,
                                                 const StopToken& stop) const {
  ARGMESH_RETURN_IF_ERROR(CheckSearchQuery(query));
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  Stopwatch stopwatch;
  ARGMESH_ASSIGN_OR_RETURN(
      const GallerySnapshotPtr gallery,
      gallery_.Snapshot(query.collection, query.min_generation));
  ARGMESH_ASSIGN_OR_RETURN(QueryGraph resolved,
                           Resolve(query.query, gallery->settings, stop));
  const MatchableGraph graph(resolved.graph);
  SearchAnswer answer;
  answer.stats.query_time = stopwatch.Lap();
  ARGMESH_ASSIGN_OR_RETURN(
      const Ranking ranking,
      ranker_->Rank(*gallery, RankQueryOf(query, graph), stop));
  answer.stats.match_time = stopwatch.Lap();
  FillMatches(query, graph, ranking, stop, answer.matches);
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  answer.stats.correspondence_time = stopwatch.Lap();

  answer.stats.generation = gallery->generation;
  answer.stats.shapes_considered = ranking.considered;
  answer.stats.shapes_matched = ranking.matched;
  answer.stats.shapes_unusable =
      gallery->damaged_shapes + gallery->outdated_shapes;
  answer.stats.exhaustive =
      ranking.exhaustive && answer.stats.shapes_unusable == 0;
  if (query.query_graph) answer.query_graph = std::move(resolved);
  return answer;
}

absl::StatusOr<ComparedShapes> ShapeSearch::Compare(
    const CompareQuery& query, const StopToken& stop) const {
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", query.collection));
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRecord collection,
                           catalog_.GetCollection(query.collection));
  ARGMESH_ASSIGN_OR_RETURN(QueryGraph a,
                           Resolve(query.a, collection.settings, stop));
  ARGMESH_ASSIGN_OR_RETURN(QueryGraph b,
                           Resolve(query.b, collection.settings, stop));
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  ComparedShapes compared;
  compared.match =
      MatchGraphs(query.mode, MatchableGraph(a.graph), MatchableGraph(b.graph),
                  {.attributes = query.attributes});
  if (query.graphs) {
    compared.a = std::move(a);
    compared.b = std::move(b);
  }
  return compared;
}

}  // namespace argmesh
