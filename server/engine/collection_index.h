// The shapes of one collection in memory, changed in place and published as
// immutable snapshots.
//
// A shape keeps its slot while it is there; a slot that came free is used
// again. Put, PutUnusable, Remove and Publish belong to one thread at a time;
// snapshot() is thread-safe. Cost of a change: one block of
// entries, one of windows and, at Publish, two pointers for each block.
#ifndef ARGMESH_SERVER_ENGINE_COLLECTION_INDEX_H_
#define ARGMESH_SERVER_ENGINE_COLLECTION_INDEX_H_

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/engine/collection_record.h"
#include "server/engine/gallery_snapshot.h"

namespace argmesh {

class CollectionIndex {
 public:
  enum class Unusable { kDamaged, kOutdated };

  // Empty, nothing published.
  explicit CollectionIndex(const CollectionRecord& collection);

  // Takes the place of whatever the id stood for before.
  void Put(IndexedShape shape);
  void PutUnusable(const std::string& id, Unusable why);
  void Remove(const std::string& id);

  // Settings and shapes are those of `other` from now on, an index of the same
  // collection; what is published stays until the next Publish.
  void Replace(CollectionIndex&& other);

  const CollectionSettings& settings() const { return settings_; }

  // Ids of the shapes that another version described, ascending.
  std::vector<std::string> Outdated() const;

  // Makes the changes so far visible as those of `generation`.
  void Publish(int64_t generation);

  // Null before the first Publish.
  GallerySnapshotPtr snapshot() const;

 private:
  struct Block {
    std::shared_ptr<GalleryBlock> entries;
    bool published = false;  // shared with a snapshot: copied before a change
  };

  size_t TakeSlot(const std::string& id);
  GalleryEntryPtr& MutableEntry(size_t slot);
  void RemoveEntry(const std::string& id);

  const std::string collection_;
  const std::string collection_uid_;
  CollectionSettings settings_;
  int64_t switches_ = 0;  // calls of Replace
  std::vector<Block> blocks_;
  std::unordered_map<std::string, size_t> slots_;  // of the ids
  std::vector<size_t> free_slots_;
  WindowIndex windows_;
  std::unordered_map<std::string, Unusable> unusable_;

  mutable std::mutex mutex_;
  GallerySnapshotPtr snapshot_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_COLLECTION_INDEX_H_
