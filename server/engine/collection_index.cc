#include "server/engine/collection_index.h"

#include <algorithm>
#include <utility>

namespace argmesh {

CollectionIndex::CollectionIndex(const CollectionRecord& collection)
    : collection_(collection.id),
      collection_uid_(collection.uid),
      settings_(collection.settings) {}

GalleryBlock& CollectionIndex::MutableBlock(size_t position) {
  Block& block = blocks_[position / kGalleryBlockSize];
  if (block.published) {
    block.entries = std::make_shared<GalleryBlock>(*block.entries);
    block.published = false;
  }
  return *block.entries;
}

void CollectionIndex::Put(GalleryEntryPtr entry) {
  const std::string& id = entry->record.id;
  unusable_.erase(id);
  const auto [it, added] = positions_.try_emplace(id, positions_.size());
  const size_t position = it->second;
  if (!added) {
    MutableBlock(position)[position % kGalleryBlockSize] = std::move(entry);
    return;
  }
  if (position % kGalleryBlockSize == 0) {
    blocks_.push_back({std::make_shared<GalleryBlock>(), false});
  }
  MutableBlock(position).push_back(std::move(entry));
}

void CollectionIndex::PutUnusable(const std::string& id, Unusable why) {
  RemoveEntry(id);
  unusable_[id] = why;
}

void CollectionIndex::Remove(const std::string& id) {
  RemoveEntry(id);
  unusable_.erase(id);
}

void CollectionIndex::RemoveEntry(const std::string& id) {
  const auto it = positions_.find(id);
  if (it == positions_.end()) return;
  const size_t position = it->second;
  const size_t last = positions_.size() - 1;
  GalleryEntryPtr moved = MutableBlock(last).back();
  MutableBlock(last).pop_back();
  if (position != last) {
    positions_[moved->record.id] = position;
    MutableBlock(position)[position % kGalleryBlockSize] = std::move(moved);
  }
  if (last % kGalleryBlockSize == 0) blocks_.pop_back();
  positions_.erase(it);
}

void CollectionIndex::Publish(int64_t generation) {
  auto snapshot = std::make_shared<GallerySnapshot>();
  snapshot->collection = collection_;
  snapshot->collection_uid = collection_uid_;
  snapshot->settings = settings_;
  snapshot->generation = generation;
  snapshot->size = static_cast<int64_t>(positions_.size());
  snapshot->damaged_shapes = std::count_if(
      unusable_.begin(), unusable_.end(),
      [](const auto& item) { return item.second == Unusable::kDamaged; });
  snapshot->outdated_shapes =
      static_cast<int64_t>(unusable_.size()) - snapshot->damaged_shapes;
  snapshot->blocks.reserve(blocks_.size());
  for (Block& block : blocks_) {
    block.published = true;
    snapshot->blocks.push_back(block.entries);
  }
  const std::lock_guard lock(mutex_);
  snapshot_ = std::move(snapshot);
}

GallerySnapshotPtr CollectionIndex::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

}  // namespace argmesh
