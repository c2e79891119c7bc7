// Every collection in memory, kept in step with the catalog.
//
// Load reads what is stored; after each committed write Follow applies the
// catalog's changes in the order of their generations, so that a write that
// returned is seen by every later search. A collection that was switched to
// other settings is built anew beside the old state, which serves until then. A
// collection that cannot be read is reported, does not stop the others, and is
// tried again; a damaged shape is left out and counted. Thread-safe.
#ifndef ARGMESH_SERVER_ENGINE_GALLERY_H_
#define ARGMESH_SERVER_ENGINE_GALLERY_H_

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "server/engine/catalog.h"
#include "server/engine/collection_index.h"
#include "server/engine/compute_pool.h"
#include "server/engine/gallery_snapshot.h"
#include "server/engine/index_state.h"
#include "server/engine/parsed_shape.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

class Gallery {
 public:
  using StagedShapes = std::unordered_map<std::string, ParsedShape>;  // by id

  // Both must outlive the gallery.
  Gallery(const Catalog& catalog, ComputePool& pool);
  ~Gallery();

  // Once, for all that is stored; then the state is kServing.
  void Load(const StopToken& stop);
  // After it: tries the collections again that could not be read. True when
  // none is missing now.
  bool LoadMissing(const StopToken& stop);
  // The state is kClosed; waits for nothing.
  void Close();

  // Held while a collection is created or deleted in the catalog and here.
  std::unique_lock<std::mutex> LockCollections();
  void Add(const CollectionRecord& collection);
  void Remove(std::string_view collection_uid);

  // A write of `generation` was committed. `shape` is what it wrote, where
  // that is known; it saves reading it back.
  void Follow(std::string_view collection, std::string_view collection_uid,
              int64_t generation, std::optional<IndexedShape> shape);

  // kIndexLoading, kCollectionNotFound, kGenerationNotReached, or why the
  // collection could not be read.
  absl::StatusOr<GallerySnapshotPtr> Snapshot(std::string_view collection,
                                              int64_t min_generation) const;

  // As Snapshot, after the changes that are being applied now.
  absl::StatusOr<GallerySnapshotPtr> LatestSnapshot(
      std::string_view collection) const;

  // What is put aside of the collection's shapes, ready for the index: a
  // switch that has it takes moments. As Snapshot, and as `stop`.
  absl::StatusOr<StagedShapes> ReadStaged(const CollectionRecord& collection,
                                          const StopToken& stop) const;
  // Runs `commit`, which switches the collection's settings in the catalog or
  // does nothing; the index follows before any later write. Searches go on
  // with the old shapes until all are the new ones. What `commit` answers;
  // `staged` is used up unless that is none.
  absl::StatusOr<std::optional<CollectionRecord>> Switch(
      const CollectionRecord& collection, StagedShapes& staged,
      const std::function<absl::StatusOr<std::optional<CollectionRecord>>()>&
          commit);

  // Ids of the shapes that another version described, ascending. As Snapshot.
  absl::StatusOr<std::vector<std::string>> Outdated(
      std::string_view collection) const;

  IndexState state() const;
  void Watch(std::function<void(IndexState)> watcher);
  absl::Status WaitUntilServing(const StopToken& stop) const;
  std::vector<CollectionHealth> Health() const;

 private:
  class Slot;
  using SlotPtr = std::shared_ptr<Slot>;

  SlotPtr FindSlot(std::string_view collection) const;
  std::vector<SlotPtr> Slots() const;  // by id
  absl::Status AddStored();
  absl::Status LoadSlot(Slot& slot, const StopToken& stop);
  void CatchUp(Slot& slot) const;
  // With the slot's update_mutex, here and below.
  void ApplyKnown(Slot& slot) const;
  absl::Status ApplyChanges(Slot& slot) const;
  absl::Status ApplyChange(Slot& slot, const ShapeChange& change) const;
  absl::Status ApplyPut(Slot& slot, const ShapeChange& change) const;
  absl::Status Rebuild(Slot& slot) const;
  absl::Status PutCurrent(Slot& slot, const ShapeRecord& record,
                          CollectionIndex& index) const;
  void SetState(IndexState state);

  const Catalog& catalog_;
  ComputePool& pool_;
  std::mutex collections_mutex_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  IndexState state_ = IndexState::kLoading;
  std::map<std::string, SlotPtr, std::less<>> slots_;

  std::mutex watch_mutex_;  // held while watchers run: they see the order
  std::vector<std::function<void(IndexState)>> watchers_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_GALLERY_H_
