// Port: the durable truth about collections, shapes and their graphs.
//
// Repeats  A write that returned OK is durable and visible to every later
//          read; one that failed changed nothing. Every read answers from one
//          state of the catalog.
// Order    Each shape write and each switch of settings adds 1 to its
//          collection's generation, without gaps; ReadChanges replays them in
//          that order.
// Fails    by MakeError with the reasons named at each function, and anywhere
//          kStoredDataDamaged, kStoreUnavailable, kStoreFull (writes that
//          add), kOverloaded (writes), kInternal.
// Thread-safe. Calls block: writes for about one commit (5 ms).
#ifndef ARGMESH_SERVER_ENGINE_CATALOG_H_
#define ARGMESH_SERVER_ENGINE_CATALOG_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "server/engine/catalog_requests.h"
#include "server/engine/collection_record.h"
#include "server/engine/shape_record.h"
#include "server/engine/store_load.h"

namespace argmesh {

class Catalog {
 public:
  virtual ~Catalog() = default;

  // --- collections -------------------------------------------------------
  // kCollectionExists, kRequestIdReused. `record` comes with id, uid, times.
  virtual absl::StatusOr<CollectionRecord> InsertCollection(
      const CollectionRecord& record, const RequestStamp& request) = 0;
  // kCollectionNotFound, kEtagMismatch, kRequestIdReused; kFieldInvalid when a
  // stored shape has a value that is not of its newly declared type.
  virtual absl::StatusOr<CollectionRecord> UpdateCollection(
      const CollectionPatch& patch) = 0;
  // kCollectionNotFound, kCollectionNotEmpty, kEtagMismatch, kRequestIdReused.
  // Nobody sees it or its shapes any more; many shapes are left for
  // RemoveSomeDeleted.
  virtual absl::StatusOr<CollectionDeleted> DeleteCollection(
      const CollectionDelete& removal) = 0;
  // Removes some of the shapes that deleted collections left, in one small
  // write, so that others' writes come between.
  virtual absl::StatusOr<RemovedShapes> RemoveSomeDeleted() = 0;
  // kCollectionNotFound.
  virtual absl::StatusOr<CollectionRecord> GetCollection(
      std::string_view id) const = 0;
  // By id, ascending, after `after_id`.
  virtual absl::StatusOr<std::vector<CollectionRecord>> ListCollections(
      std::string_view after_id, int limit) const = 0;

  // --- shapes ------------------------------------------------------------
  // kCollectionNotFound (also when the id now belongs to another uid),
  // kShapeExists, kEtagMismatch, kRequestIdReused, kFieldInvalid
  // (CheckDeclaredValues), kGraphVersionMismatch (the collection has other
  // settings than the graph was made with).
  virtual absl::StatusOr<ShapeWritten> PutShape(const ShapePut& put) = 0;
  // kCollectionNotFound, kShapeNotFound, kEtagMismatch, kRequestIdReused,
  // kFieldInvalid.
  virtual absl::StatusOr<ShapeWritten> UpdateShape(const ShapePatch& patch) = 0;
  // kCollectionNotFound, kShapeNotFound, kEtagMismatch, kRequestIdReused.
  virtual absl::StatusOr<ShapeDeleted> DeleteShape(
      const ShapeDelete& removal) = 0;
  // All, or none. kCollectionNotFound, kShapeNotFound, kRequestIdReused.
  virtual absl::StatusOr<ShapeDeleted> DeleteShapes(
      const ShapesDelete& removal) = 0;
  // kCollectionNotFound, kShapeNotFound.
  virtual absl::StatusOr<ShapeRecord> GetShape(std::string_view collection,
                                               std::string_view id) const = 0;
  // By id, ascending. kCollectionNotFound, kFilterInvalid,
  // kFilterKeyUndeclared.
  virtual absl::StatusOr<std::vector<ShapeRecord>> ListShapes(
      std::string_view collection, const ShapeSlice& slice) const = 0;

  // --- graphs ------------------------------------------------------------
  // kCollectionNotFound, kShapeNotFound; the labels only when asked for.
  virtual absl::StatusOr<StoredGraph> ReadGraph(std::string_view collection,
                                                std::string_view id,
                                                bool with_labels) const = 0;
  // Records and graphs (no labels) of one collection by id, ascending, after
  // `after_id`. A damaged row is an item with its error, not the end.
  virtual absl::StatusOr<std::vector<ScannedGraph>> ScanGraphs(
      std::string_view collection_uid, std::string_view after_id,
      int limit) const = 0;
  // One item of a scan. kShapeNotFound.
  virtual absl::StatusOr<ScannedGraph> FindGraph(
      std::string_view collection_uid, std::string_view id) const = 0;
  // The windows of one shape, empty when it has none. kShapeNotFound.
  virtual absl::StatusOr<std::string> ReadWindows(
      std::string_view collection_uid, std::string_view id) const = 0;
  // Changes after `after_generation`, ascending, but for those that are
  // forgotten (ForgetChanges). An unknown uid has none.
  virtual absl::StatusOr<std::vector<ShapeChange>> ReadChanges(
      std::string_view collection_uid, int64_t after_generation,
      int limit) const = 0;

  // --- other settings ----------------------------------------------------
  // A collection gets other settings in three steps: a stage is begun; what
  // each shape is with the new settings is put aside, while everything goes on
  // with the old ones; once no shape is missing, one write switches all of
  // them. A stage outlives Close; it ends with its collection.
  //
  // Goes on with the stage when the collection is at it, else forgets what was
  // put aside for another. A stage of the collection's own settings is none.
  // kCollectionNotFound.
  virtual absl::Status BeginStage(std::string_view collection,
                                  std::string_view collection_uid,
                                  const SettingsStage& stage) = 0;
  // In place of what was put aside for the shape before. kCollectionNotFound,
  // kShapeNotFound, kEtagMismatch (the shape has another mesh),
  // kGraphVersionMismatch (the collection is not at this stage).
  virtual absl::Status StageShape(const ShapeStaging& staging) = 0;
  // Ids of shapes for whose present mesh nothing is put aside, ascending,
  // after `after_id`.
  virtual absl::StatusOr<std::vector<std::string>> ListUnstaged(
      std::string_view collection_uid, std::string_view after_id,
      int limit) const = 0;
  // As ScanGraphs, of what is put aside for present meshes.
  virtual absl::StatusOr<std::vector<ScannedGraph>> ScanStaged(
      std::string_view collection_uid, std::string_view after_id,
      int limit) const = 0;
  // Gives the collection the stage's settings and every shape what was put
  // aside for it; each is then as written at the generation of the switch.
  // The collection as it is then; none, and nothing done, when a shape is
  // missing. kCollectionNotFound, kGraphVersionMismatch as StageShape.
  virtual absl::StatusOr<std::optional<CollectionRecord>> SwitchSettings(
      const SettingsSwitch& change) = 0;
  // Frees what switches and forgotten stages left behind, in small writes
  // between others. What it does not come to stays for the next call.
  virtual absl::Status RemoveUnusedGraphs(const StopToken& stop) = 0;
  // Forgets the changes of before the catalog was opened, as the above: who
  // follows it begins with the state it finds, and needs only later ones.
  virtual absl::Status ForgetChanges(const StopToken& stop) = 0;

  // --- meshes and requests -----------------------------------------------
  virtual absl::StatusOr<bool> IsMeshReferenced(
      const Sha256Digest& sha256) const = 0;
  // The first answer to PutShape's request when there was one.
  // kRequestIdReused.
  virtual absl::StatusOr<std::optional<ShapeWritten>> FindPutShape(
      const RequestStamp& request) const = 0;

  // Sizes and work done. Never fails: what cannot be read is 0.
  virtual StoreLoad Load() const = 0;

  // Finishes the writes that wait, then refuses all others. Idempotent.
  virtual absl::Status Close() = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_CATALOG_H_
