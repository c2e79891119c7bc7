// Searching a collection and comparing two shapes.
#ifndef ARGMESH_SERVER_ENGINE_SHAPE_SEARCH_H_
#define ARGMESH_SERVER_ENGINE_SHAPE_SEARCH_H_

#include <memory>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "server/engine/catalog.h"
#include "server/engine/compute_pool.h"
#include "server/engine/containment_ranker.h"
#include "server/engine/engine_options.h"
#include "server/engine/gallery.h"
#include "server/engine/mesh_store.h"
#include "server/engine/query_resolver.h"
#include "server/engine/search_requests.h"
#include "server/engine/shape_ranker.h"
#include "server/engine/slot_selection.h"

namespace argmesh {

class ShapeSearch {
 public:
  // All must outlive it.
  ShapeSearch(const EngineOptions& options, const Catalog& catalog,
              const MeshStore& meshes, const Gallery& gallery,
              MeshMemory& memory, ComputePool& pool);

  // The ranking, then the full match of what is answered.
  absl::StatusOr<SearchAnswer> Search(const SearchQuery& query,
                                      const StopToken& stop) const;
  absl::StatusOr<ComparedShapes> Compare(const CompareQuery& query,
                                         const StopToken& stop) const;

 private:
  struct SearchedShapes {
    GallerySnapshotPtr gallery;
    SlotSelection slots;
  };

  absl::StatusOr<SearchedShapes> Select(const SearchQuery& query,
                                        const StopToken& stop) const;
  absl::StatusOr<ResolvedQuery> Resolve(const SearchQuery& query,
                                        const CollectionSettings& settings,
                                        const StopToken& stop) const;
  // As Resolve; `searched` is selected again when the collection was switched
  // to other settings between it and the query's graph.
  absl::StatusOr<ResolvedQuery> ResolveFor(const SearchQuery& query,
                                           const StopToken& stop,
                                           SearchedShapes& searched) const;
  absl::StatusOr<std::pair<ResolvedQuery, ResolvedQuery>> ResolveBoth(
      const CompareQuery& query, const StopToken& stop) const;
  absl::Status SearchGraphs(const SearchQuery& query,
                            const ResolvedQuery& resolved,
                            const SearchedShapes& searched,
                            const StopToken& stop, SearchAnswer& answer) const;
  absl::Status SearchWindows(const SearchQuery& query,
                             const ResolvedQuery& resolved,
                             const SearchedShapes& searched,
                             const StopToken& stop, SearchAnswer& answer) const;
  static SearchMatch CompareGraphs(const CompareQuery& query,
                                   const ResolvedQuery& a,
                                   const ResolvedQuery& b);
  absl::StatusOr<SearchMatch> CompareWindows(const CompareQuery& query,
                                             const ResolvedQuery& a,
                                             const ResolvedQuery& b,
                                             const StopToken& stop) const;
  // Gives verified matches the components that lie on each other.
  absl::Status PlaceMatches(const SearchQuery& query,
                            const CollectionSettings& settings,
                            const ResolvedQuery& resolved,
                            const StopToken& stop,
                            std::vector<SearchMatch>& matches) const;

  ComputePool& pool_;
  const Catalog& catalog_;
  const Gallery& gallery_;
  const QueryResolver resolver_;
  const std::unique_ptr<ShapeRanker> ranker_;
  const ContainmentRanker containment_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SHAPE_SEARCH_H_
