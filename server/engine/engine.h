// The shape-retrieval engine: everything the service does, without gRPC.
//
// Thread-safe. Every call blocks until it is done and is meant to run on
// pool() (AddShape as kCompute, searches and comparisons as kSearch, pages,
// batches and graphs as kBulk, the rest as kQuick). A StopToken is checked at
// least every 50 ms of work; a write that has reached the catalog completes.
//
// Repeats  equal state and query give bit-equal answers, whatever the threads.
// Fails    with MakeError's statuses; the reasons are named at each function,
//          besides kDeadlineExceeded, kCancelled, kDraining after Close,
//          kStoreFull, kStoreUnavailable, kStoredDataDamaged, kInternal.
#ifndef ARGMESH_SERVER_ENGINE_ENGINE_H_
#define ARGMESH_SERVER_ENGINE_ENGINE_H_

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "server/engine/catalog.h"
#include "server/engine/compute_pool.h"
#include "server/engine/engine_options.h"
#include "server/engine/import_source.h"
#include "server/engine/index_state.h"
#include "server/engine/item_run.h"
#include "server/engine/mesh_store.h"
#include "server/engine/mesh_upload.h"
#include "server/engine/reindex_report.h"
#include "server/engine/search_requests.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

class Engine {
 public:
  // Starts to load the index in the background; returns before that is done.
  static absl::StatusOr<std::unique_ptr<Engine>> Create(
      const EngineOptions& options, std::unique_ptr<Catalog> catalog,
      std::unique_ptr<MeshStore> meshes);
  ~Engine();  // Close

  ComputePool& pool();
  const EngineOptions& options() const;

  // --- collections: kNameInvalid, kFieldInvalid, kCollectionNotFound -------
  // kCollectionExists, kRequestIdReused.
  absl::StatusOr<CollectionRecord> CreateCollection(const NewCollection& spec);
  absl::StatusOr<CollectionRecord> GetCollection(std::string_view id) const;
  // kPageTokenInvalid.
  absl::StatusOr<CollectionPage> ListCollections(const PageRequest& page) const;
  // kEtagMismatch, kRequestIdReused. Time and request are filled in here.
  absl::StatusOr<CollectionRecord> UpdateCollection(CollectionPatch patch,
                                                    const RequestKey& key = {});
  // kCollectionNotEmpty, kEtagMismatch, kRequestIdReused. The request is filled
  // in here.
  absl::Status DeleteCollection(CollectionDelete removal,
                                const RequestKey& key = {});

  // --- shapes: also kShapeNotFound -----------------------------------------
  // kMeshTooLarge from the announcement alone.
  absl::StatusOr<std::unique_ptr<MeshUpload>> StartUpload(
      const UploadAnnouncement& announced);
  // Parses, abstracts, stores and indexes; searchable when it returns. The
  // mesh is its bytes or Finish() of an upload. kMesh..., kShapeExists,
  // kEtagMismatch, kRequestIdReused. What fails leaves nothing behind.
  absl::StatusOr<AddedShape> AddShape(const NewShape& shape, MeshSource mesh,
                                      const StopToken& stop = {});
  absl::StatusOr<ShapeRecord> GetShape(const ShapeRef& shape) const;
  // Those that `filter` (MetadataFilter) holds for. kPageTokenInvalid, also
  // with another filter, kFilterInvalid, kFilterKeyUndeclared.
  absl::StatusOr<ShapePage> ListShapes(std::string_view collection,
                                       const PageRequest& page,
                                       const std::string& filter = "") const;
  // kEtagMismatch, kRequestIdReused. Time and request are filled in here.
  absl::StatusOr<ShapeRecord> UpdateShape(ShapePatch patch,
                                          const RequestKey& key = {});
  // The collection's generation after it. kEtagMismatch, kRequestIdReused.
  absl::StatusOr<int64_t> DeleteShape(const ShapeRemoval& removal);
  // All, or none. kRequestIdReused. The request is filled in here.
  absl::StatusOr<int64_t> DeleteShapes(ShapesDelete removal,
                                       const RequestKey& key = {});
  // kMeshNotStored.
  absl::StatusOr<std::unique_ptr<MeshReader>> OpenMesh(
      const ShapeRef& shape) const;
  // kGraphVersionMismatch.
  absl::StatusOr<ShapeGraphAnswer> GetGraph(const ShapeRef& shape,
                                            bool with_labels) const;

  // --- long work, on the caller's thread and pool(); as RunItems -----------
  // OK when the collection's shapes can be described anew now, with `settings`
  // if they are given. kMeshNotStored, kFieldInvalid, kOverloaded (it is being
  // reindexed).
  absl::Status CheckReindex(
      std::string_view id,
      const std::optional<CollectionSettings>& settings) const;
  // Describes the shapes that another version described anew from their
  // meshes; a failure is of its shape, and it stays as it was. With `settings`
  // it then describes every shape with these and, when none failed, switches
  // the collection to them, all at once. Searches go on with what was there
  // before, and shapes may be written meanwhile. What was described is kept for
  // the next call when it is stopped or fails. Items are shape ids. As
  // CheckReindex, kIndexLoading.
  absl::StatusOr<ReindexReport> Reindex(
      const std::string& collection,
      const std::optional<CollectionSettings>& settings,
      const RunControl& control);
  // Stores the mesh files below a folder of `source`. Items are their paths,
  // which are their source_uri and make their ids. kFileUnreadable.
  absl::StatusOr<RunReport> Import(const FolderImport& folder,
                                   const ImportSource& source,
                                   const RunControl& control);

  // --- search --------------------------------------------------------------
  // kIndexLoading, kGenerationNotReached, kMesh..., kGraphVersionMismatch,
  // kGraphInvalid, kNodeNotFound, kFilterInvalid, kFilterKeyUndeclared.
  absl::StatusOr<SearchAnswer> Search(const SearchQuery& query,
                                      const StopToken& stop = {}) const;
  absl::StatusOr<ComparedShapes> Compare(const CompareQuery& query,
                                         const StopToken& stop = {}) const;

  // --- state ---------------------------------------------------------------
  IndexState index_state() const;
  // Called at every change, from any thread; at once with the present state.
  void WatchIndexState(std::function<void(IndexState)> watcher);
  // Blocks until the index serves (OK), is closed or `stop` says so.
  absl::Status WaitUntilServing(const StopToken& stop = {}) const;
  std::vector<CollectionHealth> Health() const;  // by id

  StoreLoad Store() const;

  // Refuses new work, waits for what runs, closes the catalog. Idempotent.
  absl::Status Close();

 private:
  class Parts;
  explicit Engine(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_ENGINE_H_
