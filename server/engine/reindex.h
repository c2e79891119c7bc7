// Describing the shapes of a collection anew from their meshes: those of
// another version, and all of them with other settings.
//
// With other settings every shape's new description is put aside first
// (Catalog::StageShape), in rounds, because shapes come and change meanwhile;
// then one write switches the collection. All or nothing: a shape that cannot
// be described keeps the collection at its settings, and what is put aside
// stays for the next run. Thread-safe.
#ifndef ARGMESH_SERVER_ENGINE_REINDEX_H_
#define ARGMESH_SERVER_ENGINE_REINDEX_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "server/engine/catalog.h"
#include "server/engine/compute_pool.h"
#include "server/engine/gallery.h"
#include "server/engine/ingest.h"
#include "server/engine/item_run.h"
#include "server/engine/reindex_report.h"
#include "server/engine/running_reindexes.h"

namespace argmesh {

class Reindexer {
 public:
  // All must outlive it.
  Reindexer(Catalog& catalog, Gallery& gallery, Ingest& ingest,
            ComputePool& pool, RunningReindexes& running)
      : catalog_(catalog),
        gallery_(gallery),
        ingest_(ingest),
        pool_(pool),
        running_(running) {}

  // The collection, when it can be reindexed now, with `settings` when they are
  // given. kCollectionNotFound, kMeshNotStored, kFieldInvalid, kOverloaded (it
  // is being reindexed).
  absl::StatusOr<CollectionRecord> Check(
      std::string_view id,
      const std::optional<CollectionSettings>& settings) const;

  // Items are shape ids. As Check, kIndexLoading, and as RunItems.
  absl::StatusOr<ReindexReport> Run(
      const std::string& collection,
      const std::optional<CollectionSettings>& settings,
      const RunControl& control);

 private:
  class Rounds;  // several runs over items, reported as one

  absl::StatusOr<ItemOutcome> DescribeAnew(const CollectionRecord& collection,
                                           const std::string& id,
                                           const StopToken& stop);
  absl::StatusOr<ItemOutcome> PutAside(const CollectionRecord& collection,
                                       const CollectionSettings& settings,
                                       const std::string& id,
                                       const StopToken& stop);
  absl::StatusOr<CollectionRecord> DescribeOutdated(CollectionRecord collection,
                                                    Rounds& rounds);
  absl::StatusOr<CollectionRecord> SwitchTo(const CollectionSettings& settings,
                                            CollectionRecord collection,
                                            RunningReindexes::Run& run,
                                            Rounds& rounds);
  absl::StatusOr<std::vector<std::string>> ListUnstaged(
      const CollectionRecord& collection) const;

  Catalog& catalog_;
  Gallery& gallery_;
  Ingest& ingest_;
  ComputePool& pool_;
  RunningReindexes& running_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_REINDEX_H_
