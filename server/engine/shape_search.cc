#include "server/engine/shape_search.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "core/base/status_macros.h"
#include "core/base/stopwatch.h"
#include "core/containment/overlaid_faces.h"
#include "core/containment/target_windows.h"
#include "core/matching/fused_score.h"
#include "core/matching/match_placed.h"
#include "core/mesh/mesh_repair.h"
#include "server/engine/error_reason.h"
#include "server/engine/request_rules.h"
#include "server/engine/search_reranking.h"

namespace argmesh {
namespace {

constexpr double kMinAlike = 0.8;
// Verified matches whose components are found by place; each reads a mesh.
constexpr size_t kMaxPlaced = 20;

// Notes how long each stage took.
class StageClock {
 public:
  explicit StageClock(std::vector<StageTime>& stages) : stages_(stages) {}

  void Lap(std::string stage) {
    stages_.push_back({std::move(stage), stopwatch_.Lap()});
  }

 private:
  std::vector<StageTime>& stages_;
  Stopwatch stopwatch_;
};

std::string ExcludedId(const SearchQuery& query) {
  const auto* stored = std::get_if<ShapeRef>(&query.query);
  const bool own = stored != nullptr && stored->collection == query.collection;
  return query.exclude_query && own ? stored->id : "";
}

QueryNeeds NeedsOf(MatchMode mode, RankingMethod ranking) {
  const bool fused = ranking == RankingMethod::kFused;
  const bool partial = mode == MatchMode::kPartial;
  return {.signature = fused && !partial,
          .windows = fused && partial,
          .surface = fused && partial};
}

std::vector<ScoreTerm> FusedTerms(double graph, double signature) {
  return {{"graph", ScaledGraphScore(graph), kGraphWeight},
          {"signature", signature, kSignatureWeight}};
}

// Of shapes that are not alike handedness says nothing.
Handedness HandednessOf(const PackedSignature& a, const PackedSignature& b,
                        double similarity) {
  return similarity < kMinAlike ? Handedness::kUndecided
                                : CompareHandedness(a, b);
}

// Of a search or a comparison.
template <typename Query>
MatchOptions OptionsOf(const Query& query) {
  return {.attributes = query.attributes, .levels = query.levels};
}

// More than are answered where their order is looked at again.
int RankedShapesOf(const SearchQuery& query) {
  return query.rerank ? std::max(query.limit, kRerankedShapes) : query.limit;
}

RankQuery RankQueryOf(const SearchQuery& query, const SlotSelection& slots,
                      const MatchableGraph& graph,
                      const PackedSignature* signature) {
  return {.graph = graph,
          .mode = query.mode,
          .match = OptionsOf(query),
          .signature = signature,
          .candidates = query.candidates,
          .exact = query.exact,
          .limit = RankedShapesOf(query),
          .min_score = query.min_score,
          .min_query_coverage = query.min_query_coverage,
          .slots = slots};
}

SearchMatch MatchOf(ContainingShape shape) {
  SearchMatch match;
  match.score = shape.score;
  match.terms = ContainmentTerms(shape.match, shape.graph.score);
  match.match = std::move(shape.graph);
  match.match.query_coverage = shape.match.query_coverage;
  match.match.target_coverage = shape.match.target_coverage;
  match.tied = shape.tied;
  match.containment = std::move(shape.match);
  return match;
}

// Gives a match the components that lie on each other.
void PlaceComponents(const ShapeGraph& query_graph,
                     const LabelledSurface& query,
                     const ShapeGraph& target_graph,
                     const LabelledSurface& target, const MatchOptions& options,
                     SearchMatch& match) {
  MatchPlaced(
      {query_graph, query.labels}, {target_graph, target.labels},
      OverlayFaces(query.mesh, target.mesh, match.containment->transform),
      options, match.match);
}

bool HasWindows(const QueryWindows& query) {
  return std::any_of(
      query.levels.begin(), query.levels.end(),
      [](const QueryLevel& level) { return !level.windows.empty(); });
}

}  // namespace

ShapeSearch::ShapeSearch(const EngineOptions& options, const Catalog& catalog,
                         const MeshStore& meshes, const Gallery& gallery,
                         MeshMemory& memory, ComputePool& pool)
    : pool_(pool),
      catalog_(catalog),
      gallery_(gallery),
      resolver_(options, catalog, meshes, memory),
      ranker_(MakeTwoStageRanker(pool)),
      containment_(catalog, pool) {}

absl::StatusOr<ShapeSearch::SearchedShapes> ShapeSearch::Select(
    const SearchQuery& query, const StopToken& stop) const {
  SearchedShapes searched;
  ARGMESH_ASSIGN_OR_RETURN(
      searched.gallery,
      gallery_.Snapshot(query.collection, query.min_generation));
  MetadataFilter filter;
  if (!query.filter.empty()) {
    ARGMESH_ASSIGN_OR_RETURN(const CollectionRecord collection,
                             catalog_.GetCollection(query.collection));
    ARGMESH_ASSIGN_OR_RETURN(
        filter, MetadataFilter::Parse(query.filter, collection.metadata_keys));
  }
  ARGMESH_ASSIGN_OR_RETURN(
      searched.slots,
      SelectSlots(*searched.gallery, filter, ExcludedId(query), stop));
  return searched;
}

absl::StatusOr<ResolvedQuery> ShapeSearch::Resolve(
    const SearchQuery& query, const CollectionSettings& settings,
    const StopToken& stop) const {
  const QueryNeeds needs = NeedsOf(query.mode, query.ranking);
  if (query.region_nodes.empty()) {
    return resolver_.Resolve(query.query, settings, needs, stop);
  }
  return resolver_.ResolveRegion(std::get<ShapeRef>(query.query),
                                 query.region_nodes, settings, needs, stop);
}

absl::StatusOr<ResolvedQuery> ShapeSearch::ResolveFor(
    const SearchQuery& query, const StopToken& stop,
    SearchedShapes& searched) const {
  while (true) {
    absl::StatusOr<ResolvedQuery> resolved =
        Resolve(query, searched.gallery->settings, stop);
    if (ReasonOf(resolved.status()) != ErrorReason::kGraphVersionMismatch) {
      return resolved;
    }
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    ARGMESH_ASSIGN_OR_RETURN(const GallerySnapshotPtr latest,
                             gallery_.LatestSnapshot(query.collection));
    if (latest->switches == searched.gallery->switches) return resolved;
    ARGMESH_ASSIGN_OR_RETURN(searched, Select(query, stop));
  }
}

absl::Status ShapeSearch::SearchGraphs(const SearchQuery& query,
                                       const ResolvedQuery& resolved,
                                       const SearchedShapes& searched,
                                       const StopToken& stop,
                                       SearchAnswer& answer) const {
  StageClock clock(answer.stats.stages);
  const MatchableGraph graph(resolved.graph.graph);
  std::optional<PackedSignature> signature;
  if (resolved.signature) signature.emplace(*resolved.signature);
  const PackedSignature* const packed = signature ? &*signature : nullptr;
  ARGMESH_ASSIGN_OR_RETURN(
      Ranking ranking,
      ranker_->Rank(*searched.gallery,
                    RankQueryOf(query, searched.slots, graph, packed), stop));
  clock.Lap("match");
  if (query.rerank && packed != nullptr) {
    ARGMESH_RETURN_IF_ERROR(RerankShapes(pool_, stop, ranking.shapes));
    ranking.shapes.resize(
        std::min(ranking.shapes.size(), static_cast<size_t>(query.limit)));
    clock.Lap("rerank");
  }
  answer.matches.resize(ranking.shapes.size());
  pool_.ParallelFor(
      WorkClass::kSearch, static_cast<int64_t>(ranking.shapes.size()),
      [&](int64_t i) {
        if (!stop.Check().ok()) return;
        const RankedShape& ranked = ranking.shapes[static_cast<size_t>(i)];
        SearchMatch& match = answer.matches[static_cast<size_t>(i)];
        match.shape = ranked.entry->record;
        match.score = ranked.score;
        match.candidate_rank = ranked.candidate_rank;
        match.match = MatchGraphs(query.mode, graph, ranked.entry->graph,
                                  OptionsOf(query));
        if (packed == nullptr) return;
        match.terms = FusedTerms(match.match.score, ranked.signature);
        match.handedness =
            HandednessOf(*packed, ranked.entry->signature, ranked.signature);
      });
  clock.Lap("correspondence");
  answer.stats.shapes_considered = ranking.considered;
  answer.stats.shapes_matched = ranking.matched;
  answer.stats.exhaustive = ranking.exhaustive;
  return stop.Check();
}

absl::Status ShapeSearch::SearchWindows(const SearchQuery& query,
                                        const ResolvedQuery& resolved,
                                        const SearchedShapes& searched,
                                        const StopToken& stop,
                                        SearchAnswer& answer) const {
  const MatchableGraph graph(resolved.graph.graph);
  ARGMESH_ASSIGN_OR_RETURN(
      ContainmentAnswer found,
      containment_.Rank(*searched.gallery,
                        {.windows = *resolved.windows,
                         .graph = graph,
                         .match = OptionsOf(query),
                         .sha256 = resolved.sha256,
                         .limit = RankedShapesOf(query),
                         .candidates = query.candidates,
                         .exact = query.exact,
                         .min_score = query.min_score,
                         .min_query_coverage = query.min_query_coverage,
                         .slots = searched.slots},
                        stop));
  std::vector<StageTime>& stages = answer.stats.stages;
  stages.push_back({"candidates", found.candidate_time});
  stages.push_back({"match", found.match_time});
  stages.push_back({"verification", found.verification_time});
  stages.push_back({"correspondence", found.graph_time});
  if (query.rerank) {
    StageClock clock(stages);
    ARGMESH_RETURN_IF_ERROR(RerankContaining(pool_, stop, found.shapes));
    clock.Lap("rerank");
  }
  found.shapes.resize(
      std::min(found.shapes.size(), static_cast<size_t>(query.limit)));
  for (ContainingShape& shape : found.shapes) {
    const ShapeRecord& record = shape.entry->record;
    answer.matches.push_back(MatchOf(std::move(shape)));
    answer.matches.back().shape = record;
  }
  if (query.correspondence) {
    StageClock clock(stages);
    ARGMESH_RETURN_IF_ERROR(PlaceMatches(query, searched.gallery->settings,
                                         resolved, stop, answer.matches));
    clock.Lap("placement");
  }
  answer.query_generic = found.generic;
  answer.stats.shapes_considered = found.considered;
  answer.stats.shapes_matched = found.matched;
  answer.stats.shapes_unusable += found.damaged;
  answer.stats.exhaustive = found.laid == found.considered;
  return stop.Check();
}

absl::Status ShapeSearch::PlaceMatches(
    const SearchQuery& query, const CollectionSettings& settings,
    const ResolvedQuery& resolved, const StopToken& stop,
    std::vector<SearchMatch>& matches) const {
  std::vector<SearchMatch*> verified;
  for (SearchMatch& match : matches) {
    if (match.containment->verified && verified.size() < kMaxPlaced) {
      verified.push_back(&match);
    }
  }
  pool_.ParallelFor(
      WorkClass::kSearch, static_cast<int64_t>(verified.size()),
      [&](int64_t i) {
        if (!stop.Check().ok()) return;
        SearchMatch& match = *verified[static_cast<size_t>(i)];
        // One that went, or became another mesh, keeps what its graph says.
        const absl::StatusOr<StoredSurface> target =
            resolver_.ReadSurface({query.collection, match.shape.id}, settings);
        if (!target.ok() || target->sha256 != match.shape.sha256) return;
        PlaceComponents(resolved.graph.graph, *resolved.surface, target->graph,
                        target->surface, OptionsOf(query), match);
      });
  return stop.Check();
}

absl::StatusOr<SearchAnswer> ShapeSearch::Search(const SearchQuery& query,
                                                 const StopToken& stop) const {
  ARGMESH_RETURN_IF_ERROR(CheckSearchQuery(query));
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  SearchAnswer answer;
  StageClock clock(answer.stats.stages);
  ARGMESH_ASSIGN_OR_RETURN(SearchedShapes searched, Select(query, stop));
  clock.Lap("filter");
  ARGMESH_ASSIGN_OR_RETURN(ResolvedQuery resolved,
                           ResolveFor(query, stop, searched));
  const GallerySnapshot& gallery = *searched.gallery;
  ARGMESH_RETURN_IF_ERROR(CheckLevels(query.levels, resolved.graph.graph));
  clock.Lap("query");
  answer.stats.generation = gallery.generation;
  answer.stats.shapes_unusable =
      gallery.damaged_shapes + gallery.outdated_shapes;
  // All of a narrow strip is border: nothing of it is a window.
  answer.query_generic = resolved.windows && !HasWindows(*resolved.windows);
  ARGMESH_RETURN_IF_ERROR(
      resolved.windows && !answer.query_generic
          ? SearchWindows(query, resolved, searched, stop, answer)
          : SearchGraphs(query, resolved, searched, stop, answer));
  answer.stats.exhaustive &= answer.stats.shapes_unusable == 0;
  if (!query.correspondence) {
    for (SearchMatch& match : answer.matches) match.match.pairs.clear();
  }
  if (query.query_graph) answer.query_graph = std::move(resolved.graph);
  return answer;
}

absl::StatusOr<std::pair<ResolvedQuery, ResolvedQuery>>
ShapeSearch::ResolveBoth(const CompareQuery& query,
                         const StopToken& stop) const {
  const QueryNeeds needs = NeedsOf(query.mode, query.ranking);
  QueryNeeds target_needs = needs;
  target_needs.windows = false;
  ARGMESH_ASSIGN_OR_RETURN(CollectionRecord collection,
                           catalog_.GetCollection(query.collection));
  while (true) {
    absl::StatusOr<ResolvedQuery> a =
        resolver_.Resolve(query.a, collection.settings, needs, stop);
    absl::Status status = a.status();
    if (status.ok()) {
      absl::StatusOr<ResolvedQuery> b =
          resolver_.Resolve(query.b, collection.settings, target_needs, stop);
      if (b.ok()) return std::make_pair(*std::move(a), *std::move(b));
      status = b.status();
    }
    if (ReasonOf(status) != ErrorReason::kGraphVersionMismatch) return status;
    // Once more when the collection was switched to other settings meanwhile.
    const int64_t before = collection.revision;
    ARGMESH_ASSIGN_OR_RETURN(collection,
                             catalog_.GetCollection(query.collection));
    if (collection.revision == before) return status;
  }
}

SearchMatch ShapeSearch::CompareGraphs(const CompareQuery& query,
                                       const ResolvedQuery& a,
                                       const ResolvedQuery& b) {
  SearchMatch match;
  match.match = MatchGraphs(query.mode, MatchableGraph(a.graph.graph),
                            MatchableGraph(b.graph.graph), OptionsOf(query));
  match.score = match.match.score;
  if (a.signature && b.signature) {
    const PackedSignature packed_a(*a.signature);
    const PackedSignature packed_b(*b.signature);
    const double similarity = SignatureSimilarity(packed_a, packed_b);
    match.terms = FusedTerms(match.match.score, similarity);
    match.score = FusedScore(match.match.score, similarity);
    match.handedness = HandednessOf(packed_a, packed_b, similarity);
  }
  return match;
}

absl::StatusOr<SearchMatch> ShapeSearch::CompareWindows(
    const CompareQuery& query, const ResolvedQuery& a, const ResolvedQuery& b,
    const StopToken& stop) const {
  ARGMESH_ASSIGN_OR_RETURN(const RepairedMesh repaired,
                           RepairMesh(b.surface->mesh));
  ARGMESH_ASSIGN_OR_RETURN(const TargetWindows target,
                           ExtractTargetWindows(repaired.mesh, {}, stop));
  ARGMESH_ASSIGN_OR_RETURN(
      ContainingShape shape,
      containment_.Match({.query = *a.windows,
                          .query_graph = MatchableGraph(a.graph.graph),
                          .target = target,
                          .target_graph = MatchableGraph(b.graph.graph),
                          .match = OptionsOf(query),
                          .same_bytes = a.sha256 && a.sha256 == b.sha256},
                         stop));
  SearchMatch match = MatchOf(std::move(shape));
  if (match.containment->verified) {
    PlaceComponents(a.graph.graph, *a.surface, b.graph.graph, *b.surface,
                    OptionsOf(query), match);
  }
  return match;
}

absl::StatusOr<ComparedShapes> ShapeSearch::Compare(
    const CompareQuery& query, const StopToken& stop) const {
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", query.collection));
  ARGMESH_ASSIGN_OR_RETURN(auto resolved, ResolveBoth(query, stop));
  auto& [a, b] = resolved;
  ARGMESH_RETURN_IF_ERROR(CheckLevels(query.levels, a.graph.graph));
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  ComparedShapes compared;
  if (a.windows && b.surface && HasWindows(*a.windows)) {
    ARGMESH_ASSIGN_OR_RETURN(compared.match, CompareWindows(query, a, b, stop));
  } else {
    compared.match = CompareGraphs(query, a, b);
  }
  if (query.graphs) {
    compared.a = std::move(a.graph);
    compared.b = std::move(b.graph);
  }
  return compared;
}

}  // namespace argmesh
