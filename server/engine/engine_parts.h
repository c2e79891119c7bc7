// What an Engine is made of; of no use to anybody else.
#ifndef ARGMESH_SERVER_ENGINE_ENGINE_PARTS_H_
#define ARGMESH_SERVER_ENGINE_ENGINE_PARTS_H_

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/engine/catalog.h"
#include "server/engine/compute_pool.h"
#include "server/engine/engine.h"
#include "server/engine/engine_options.h"
#include "server/engine/gallery.h"
#include "server/engine/housekeeping.h"
#include "server/engine/ingest.h"
#include "server/engine/mesh_memory.h"
#include "server/engine/mesh_store.h"
#include "server/engine/reindex.h"
#include "server/engine/running_reindexes.h"
#include "server/engine/shape_search.h"

namespace argmesh {

class Engine::Parts {
 public:
  Parts(const EngineOptions& engine_options,
        std::unique_ptr<Catalog> engine_catalog,
        std::unique_ptr<MeshStore> engine_meshes);

  absl::Status CheckOpen() const;  // kDraining
  // StampRequest, remembered for as long as the options say.
  absl::StatusOr<RequestStamp> Stamp(
      const RequestKey& key, std::string_view method,
      const std::vector<std::string>& fields) const;
  // Index and meshes do without what the catalog has no more; its generation.
  int64_t FollowDeletion(const std::string& collection,
                         const ShapeDeleted& deleted);

  // In the order they are made; each may use those before it.
  const EngineOptions options;
  const std::unique_ptr<Catalog> catalog;
  const std::unique_ptr<MeshStore> meshes;
  ComputePool pool;
  MeshMemory mesh_memory;
  Gallery gallery;
  RunningReindexes running_reindexes;
  Ingest ingest;
  Reindexer reindexer;
  ShapeSearch search;
  std::atomic<bool> closed{false};
  std::mutex close_mutex;
  Housekeeping housekeeping;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_ENGINE_PARTS_H_
