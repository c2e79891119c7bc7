#include "server/engine/collection_index.h"

#include <algorithm>
#include <utility>

namespace argmesh {

CollectionIndex::CollectionIndex(const CollectionRecord& collection)
    : collection_(collection.id),
      collection_uid_(collection.uid),
      settings_(collection.settings) {}

size_t CollectionIndex::TakeSlot(const std::string& id) {
  const auto it = slots_.find(id);
  if (it != slots_.end()) return it->second;
  size_t slot = slots_.size();  // every slot below is taken
  if (!free_slots_.empty()) {
    slot = free_slots_.back();
    free_slots_.pop_back();
  }
  slots_[id] = slot;
  return slot;
}

GalleryEntryPtr& CollectionIndex::MutableEntry(size_t slot) {
  const size_t at = slot / kGalleryBlockSize;
  if (at == blocks_.size()) {
    blocks_.push_back({std::make_shared<GalleryBlock>(), false});
  }
  Block& block = blocks_[at];
  if (block.published) {
    block.entries = std::make_shared<GalleryBlock>(*block.entries);
    block.published = false;
  }
  const size_t place = slot % kGalleryBlockSize;
  if (place == block.entries->size()) block.entries->emplace_back();
  return (*block.entries)[place];
}

void CollectionIndex::Put(IndexedShape shape) {
  unusable_.erase(shape.entry->record.id);
  const size_t slot = TakeSlot(shape.entry->record.id);
  windows_.Set(static_cast<int64_t>(slot), shape.words);
  MutableEntry(slot) = std::move(shape.entry);
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
  const auto it = slots_.find(id);
  if (it == slots_.end()) return;
  const size_t slot = it->second;
  MutableEntry(slot) = nullptr;
  windows_.Erase(static_cast<int64_t>(slot));
  free_slots_.push_back(slot);
  slots_.erase(it);
}

void CollectionIndex::Replace(CollectionIndex&& other) {
  settings_ = other.settings_;
  ++switches_;
  blocks_ = std::move(other.blocks_);
  slots_ = std::move(other.slots_);
  free_slots_ = std::move(other.free_slots_);
  windows_ = std::move(other.windows_);
  unusable_ = std::move(other.unusable_);
}

std::vector<std::string> CollectionIndex::Outdated() const {
  std::vector<std::string> ids;
  for (const auto& [id, why] : unusable_) {
    if (why == Unusable::kOutdated) ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

void CollectionIndex::Publish(int64_t generation) {
  auto snapshot = std::make_shared<GallerySnapshot>();
  snapshot->collection = collection_;
  snapshot->collection_uid = collection_uid_;
  snapshot->settings = settings_;
  snapshot->switches = switches_;
  snapshot->generation = generation;
  snapshot->size = static_cast<int64_t>(slots_.size());
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
  snapshot->windows = windows_;
  const std::lock_guard lock(mutex_);
  snapshot_ = std::move(snapshot);
}

GallerySnapshotPtr CollectionIndex::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

}  // namespace argmesh
