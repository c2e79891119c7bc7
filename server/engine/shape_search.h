// Searching a collection and comparing two shapes.
#ifndef ARGMESH_SERVER_ENGINE_SHAPE_SEARCH_H_
#define ARGMESH_SERVER_ENGINE_SHAPE_SEARCH_H_

#include <memory>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "server/engine/catalog.h"
#include "server/engine/compute_pool.h"
#include "server/engine/engine_options.h"
#include "server/engine/gallery.h"
#include "server/engine/search_requests.h"
#include "server/engine/shape_ranker.h"

namespace argmesh {

class ShapeSearch {
 public:
  // All must outlive it.
  ShapeSearch(const EngineOptions& options, const Catalog& catalog,
              const Gallery& gallery, ComputePool& pool);

  // Two steps: the scores of all shapes, then the full match of the answer.
  absl::StatusOr<SearchAnswer> Search(const SearchQuery& query,
                                      const StopToken& stop) const;
  absl::StatusOr<ComparedShapes> Compare(const CompareQuery& query,
                                         const StopToken& stop) const;

 private:
  // kGraphVersionMismatch when a stored shape's collection has other settings
  // than `settings`.
  absl::StatusOr<QueryGraph> Resolve(const QueryShape& shape,
                                     const CollectionSettings& settings,
                                     const StopToken& stop) const;
  absl::StatusOr<QueryGraph> ResolveStored(
      const ShapeRef& shape, const CollectionSettings& settings) const;
  void FillMatches(const SearchQuery& query, const MatchableGraph& graph,
                   const Ranking& ranking, const StopToken& stop,
                   std::vector<SearchMatch>& matches) const;

  const EngineOptions& options_;
  const Catalog& catalog_;
  const Gallery& gallery_;
  ComputePool& pool_;
  std::unique_ptr<ShapeRanker> ranker_;
};

// The stored bytes as a graph. kGraphVersionMismatch, kStoredDataDamaged.
absl::StatusOr<ShapeGraph> ParseStoredGraph(const StoredGraph& stored);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SHAPE_SEARCH_H_
