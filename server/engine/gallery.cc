#include "server/engine/gallery.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

constexpr int kScanPage = 256;
constexpr int kChangePage = 256;
constexpr absl::Duration kLoadRetryDelay = absl::Seconds(1);

}  // namespace

// A collection and how far it has come.
class Gallery::Slot {
 public:
  explicit Slot(const CollectionRecord& record)
      : id(record.id), uid(record.uid), index(record) {}

  const std::string id;
  const std::string uid;
  CollectionIndex index;

  std::mutex update_mutex;  // guards changes of the index and `applied`
  int64_t applied = 0;      // generation the index has reached
  StagedShapes staged;      // for the switch that is being made

  mutable std::mutex mutex;  // guards what follows
  bool following = false;    // Load has read everything: changes are applied
  int64_t known = 0;         // highest generation seen committed
  absl::Status error;        // why `applied` stays behind `known`
  std::map<int64_t, IndexedShape> shapes;  // written, not applied yet
};

Gallery::Gallery(const Catalog& catalog, ComputePool& pool)
    : catalog_(catalog), pool_(pool) {}

Gallery::~Gallery() = default;

Gallery::SlotPtr Gallery::FindSlot(std::string_view collection) const {
  const std::lock_guard lock(mutex_);
  const auto it = slots_.find(collection);
  return it == slots_.end() ? nullptr : it->second;
}

std::vector<Gallery::SlotPtr> Gallery::Slots() const {
  std::vector<SlotPtr> slots;
  const std::lock_guard lock(mutex_);
  for (const auto& [id, slot] : slots_) slots.push_back(slot);
  return slots;
}

std::unique_lock<std::mutex> Gallery::LockCollections() {
  return std::unique_lock(collections_mutex_);
}

void Gallery::Add(const CollectionRecord& collection) {
  auto slot = std::make_shared<Slot>(collection);
  slot->following = true;
  slot->index.Publish(0);
  const std::lock_guard lock(mutex_);
  slots_[collection.id] = std::move(slot);
}

void Gallery::Remove(std::string_view collection_uid) {
  const std::lock_guard lock(mutex_);
  std::erase_if(slots_, [&](const auto& item) {
    return item.second->uid == collection_uid;
  });
}

absl::Status Gallery::AddStored() {
  const auto collections_lock = LockCollections();
  std::string after;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const std::vector<CollectionRecord> page,
                             catalog_.ListCollections(after, kScanPage));
    if (page.empty()) return absl::OkStatus();
    after = page.back().id;
    const std::lock_guard lock(mutex_);
    for (const CollectionRecord& record : page) {
      // One created since the start is there already.
      SlotPtr& slot = slots_[record.id];
      if (slot != nullptr) continue;
      slot = std::make_shared<Slot>(record);
      slot->applied = record.generation;
    }
  }
}

void Gallery::Load(const StopToken& stop) {
  while (!AddStored().ok()) {  // the catalog does not answer: it may later
    if (!stop.Check().ok()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  LoadMissing(stop);
  if (stop.Check().ok()) SetState(IndexState::kServing);
}

bool Gallery::LoadMissing(const StopToken& stop) {
  bool complete = true;
  for (const SlotPtr& slot : Slots()) {
    if (slot->index.snapshot() != nullptr) continue;
    const absl::Status status = LoadSlot(*slot, stop);
    complete = complete && status.ok();
    const std::lock_guard lock(slot->mutex);
    slot->error = status;
  }
  return complete;
}

absl::Status Gallery::LoadSlot(Slot& slot, const StopToken& stop) {
  const std::lock_guard update(slot.update_mutex);
  std::string after;
  while (true) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    ARGMESH_ASSIGN_OR_RETURN(const std::vector<ScannedGraph> page,
                             catalog_.ScanGraphs(slot.uid, after, kScanPage));
    if (page.empty()) break;
    after = page.back().record.id;
    auto shapes = ParsePage(page, pool_);
    for (size_t i = 0; i < page.size(); ++i) {
      PutParsed(slot.index, page[i].record.id, std::move(shapes[i]));
    }
  }
  {
    // From here on writers wait to apply their changes; those that did not
    // were committed before and are read below.
    const std::lock_guard lock(slot.mutex);
    slot.following = true;
    slot.known = std::max(slot.known, slot.applied + 1);
  }
  ARGMESH_RETURN_IF_ERROR(ApplyChanges(slot));
  slot.index.Publish(slot.applied);
  return absl::OkStatus();
}

void Gallery::Follow(std::string_view collection,
                     std::string_view collection_uid, int64_t generation,
                     std::optional<IndexedShape> shape) {
  const SlotPtr slot = FindSlot(collection);
  if (slot == nullptr || slot->uid != collection_uid) return;
  {
    const std::lock_guard lock(slot->mutex);
    slot->known = std::max(slot->known, generation);
    if (!slot->following) return;  // Load reads it
    if (shape) slot->shapes[generation] = *std::move(shape);
  }
  CatchUp(*slot);
}

void Gallery::CatchUp(Slot& slot) const {
  const std::lock_guard update(slot.update_mutex);
  ApplyKnown(slot);
}

void Gallery::ApplyKnown(Slot& slot) const {
  const int64_t before = slot.applied;
  const absl::Status status = ApplyChanges(slot);
  if (slot.applied != before || slot.index.snapshot() == nullptr) {
    slot.index.Publish(slot.applied);
  }
  const std::lock_guard lock(slot.mutex);
  slot.error = status;
}

absl::Status Gallery::ApplyChanges(Slot& slot) const {
  while (true) {
    {
      const std::lock_guard lock(slot.mutex);
      slot.shapes.erase(slot.shapes.begin(),
                        slot.shapes.upper_bound(slot.applied));
      if (slot.known <= slot.applied) return absl::OkStatus();
    }
    ARGMESH_ASSIGN_OR_RETURN(
        const std::vector<ShapeChange> changes,
        catalog_.ReadChanges(slot.uid, slot.applied, kChangePage));
    if (changes.empty()) {  // nothing more was committed after all
      const std::lock_guard lock(slot.mutex);
      slot.known = slot.applied;
      return absl::OkStatus();
    }
    for (const ShapeChange& change : changes) {
      // A change before it may have rebuilt everything up to a later one.
      if (change.generation <= slot.applied) continue;
      ARGMESH_RETURN_IF_ERROR(ApplyChange(slot, change));
      slot.applied = std::max(slot.applied, change.generation);
    }
  }
}

absl::Status Gallery::ApplyChange(Slot& slot, const ShapeChange& change) const {
  switch (change.kind) {
    case ShapeChange::Kind::kPut:
      return ApplyPut(slot, change);
    case ShapeChange::Kind::kDelete:
      slot.index.Remove(change.id);
      return absl::OkStatus();
    case ShapeChange::Kind::kSwitch:
      return Rebuild(slot);
  }
  return absl::InternalError("a change of no kind");
}

absl::Status Gallery::ApplyPut(Slot& slot, const ShapeChange& change) const {
  std::optional<IndexedShape> written;
  {
    const std::lock_guard lock(slot.mutex);
    const auto it = slot.shapes.find(change.generation);
    if (it != slot.shapes.end()) written = it->second;
  }
  if (written) {
    slot.index.Put(*std::move(written));
    return absl::OkStatus();
  }
  const absl::StatusOr<ScannedGraph> stored =
      catalog_.FindGraph(slot.uid, change.id);
  if (absl::IsNotFound(stored.status())) {  // a later change deletes it
    slot.index.Remove(change.id);
    return absl::OkStatus();
  }
  ARGMESH_RETURN_IF_ERROR(stored.status());
  // A switch that comes later in the log has been committed already.
  if (stored->status.ok() &&
      !MakeSameGraphs(stored->settings, slot.index.settings())) {
    return Rebuild(slot);
  }
  PutParsed(slot.index, change.id, ParseScanned(*stored));
  return absl::OkStatus();
}

absl::Status Gallery::PutCurrent(Slot& slot, const ShapeRecord& record,
                                 CollectionIndex& index) const {
  const auto it = slot.staged.find(record.id);
  if (it != slot.staged.end() &&
      it->second.entry->record.sha256 == record.sha256) {
    it->second.entry->record = record;
    index.Put({std::move(it->second.entry), std::move(it->second.words)});
    slot.staged.erase(it);
    return absl::OkStatus();
  }
  const absl::StatusOr<ScannedGraph> stored =
      catalog_.FindGraph(slot.uid, record.id);
  if (absl::IsNotFound(stored.status())) return absl::OkStatus();
  ARGMESH_RETURN_IF_ERROR(stored.status());
  PutParsed(index, record.id, ParseScanned(*stored));
  return absl::OkStatus();
}

// What is stored now, whatever was applied before; later changes are applied
// to it again, which changes nothing.
absl::Status Gallery::Rebuild(Slot& slot) const {
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRecord collection,
                           catalog_.GetCollection(slot.id));
  if (collection.uid != slot.uid) return CollectionNotFoundError(slot.id);
  CollectionIndex index(collection);
  std::string after;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(
        const std::vector<ShapeRecord> page,
        catalog_.ListShapes(slot.id, {after, kScanPage, ""}));
    if (page.empty()) break;
    after = page.back().id;
    for (const ShapeRecord& record : page) {
      ARGMESH_RETURN_IF_ERROR(PutCurrent(slot, record, index));
    }
  }
  slot.index.Replace(std::move(index));
  slot.applied = collection.generation;
  return absl::OkStatus();
}

absl::StatusOr<GallerySnapshotPtr> Gallery::Snapshot(
    std::string_view collection, int64_t min_generation) const {
  const SlotPtr slot = FindSlot(collection);
  if (slot == nullptr && state() == IndexState::kServing) {
    return CollectionNotFoundError(collection);
  }
  bool behind = false;
  absl::Status error;
  if (slot != nullptr) {
    const std::lock_guard lock(slot->mutex);
    behind = slot->following && !slot->error.ok();
    error = slot->error;
  }
  if (behind) CatchUp(*slot);
  GallerySnapshotPtr snapshot =
      slot == nullptr ? nullptr : slot->index.snapshot();
  if (snapshot == nullptr) {
    if (!error.ok()) return error;
    return WithRetryDelay(
        MakeError(ErrorReason::kIndexLoading, "the index is still loading"),
        kLoadRetryDelay);
  }
  if (snapshot->generation < min_generation) {
    return WithRetryDelay(
        MakeError(ErrorReason::kGenerationNotReached,
                  "the index has not reached min_generation",
                  {{"generation", std::to_string(snapshot->generation)}}),
        kLoadRetryDelay);
  }
  return snapshot;
}

absl::StatusOr<GallerySnapshotPtr> Gallery::LatestSnapshot(
    std::string_view collection) const {
  if (const SlotPtr slot = FindSlot(collection)) {
    const std::lock_guard update(slot->update_mutex);  // nobody applies changes
  }
  return Snapshot(collection, 0);
}

absl::StatusOr<Gallery::StagedShapes> Gallery::ReadStaged(
    const CollectionRecord& collection, const StopToken& stop) const {
  ARGMESH_RETURN_IF_ERROR(Snapshot(collection.id, 0).status());
  StagedShapes staged;
  std::string after;
  while (true) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    ARGMESH_ASSIGN_OR_RETURN(
        const std::vector<ScannedGraph> page,
        catalog_.ScanStaged(collection.uid, after, kScanPage));
    if (page.empty()) return staged;
    after = page.back().record.id;
    auto shapes = ParsePage(page, pool_);
    for (size_t i = 0; i < page.size(); ++i) {
      if (shapes[i].ok()) staged[page[i].record.id] = *std::move(shapes[i]);
    }
  }
}

absl::StatusOr<std::optional<CollectionRecord>> Gallery::Switch(
    const CollectionRecord& collection, StagedShapes& staged,
    const std::function<absl::StatusOr<std::optional<CollectionRecord>>()>&
        commit) {
  const SlotPtr slot = FindSlot(collection.id);
  if (slot == nullptr || slot->uid != collection.uid) {
    return CollectionNotFoundError(collection.id);
  }
  const std::lock_guard update(slot->update_mutex);
  ARGMESH_ASSIGN_OR_RETURN(std::optional<CollectionRecord> switched, commit());
  if (!switched) return switched;
  {
    const std::lock_guard lock(slot->mutex);
    slot->known = std::max(slot->known, switched->generation);
  }
  slot->staged = std::move(staged);
  ApplyKnown(*slot);
  slot->staged.clear();
  return switched;
}

absl::StatusOr<std::vector<std::string>> Gallery::Outdated(
    std::string_view collection) const {
  ARGMESH_RETURN_IF_ERROR(Snapshot(collection, 0).status());
  const SlotPtr slot = FindSlot(collection);
  if (slot == nullptr) return CollectionNotFoundError(collection);
  const std::lock_guard update(slot->update_mutex);
  return slot->index.Outdated();
}

IndexState Gallery::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void Gallery::SetState(IndexState state) {
  const std::lock_guard watch_lock(watch_mutex_);
  {
    const std::lock_guard lock(mutex_);
    if (state_ == state || state_ == IndexState::kClosed) return;
    state_ = state;
  }
  changed_.notify_all();
  for (const auto& watcher : watchers_) watcher(state);
}

void Gallery::Close() { SetState(IndexState::kClosed); }

void Gallery::Watch(std::function<void(IndexState)> watcher) {
  const std::lock_guard watch_lock(watch_mutex_);
  watcher(state());
  watchers_.push_back(std::move(watcher));
}

absl::Status Gallery::WaitUntilServing(const StopToken& stop) const {
  std::unique_lock lock(mutex_);
  while (state_ == IndexState::kLoading) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    changed_.wait_for(lock, std::chrono::milliseconds(10));
  }
  if (state_ == IndexState::kServing) return absl::OkStatus();
  return MakeError(ErrorReason::kDraining, "the index is closed");
}

std::vector<CollectionHealth> Gallery::Health() const {
  std::vector<CollectionHealth> health;
  for (const SlotPtr& slot : Slots()) {
    CollectionHealth& item = health.emplace_back();
    item.id = slot->id;
    if (const GallerySnapshotPtr snapshot = slot->index.snapshot()) {
      item.loaded = true;
      item.generation = snapshot->generation;
      item.shapes = snapshot->size;
      item.damaged_shapes = snapshot->damaged_shapes;
      item.outdated_shapes = snapshot->outdated_shapes;
    }
    const std::lock_guard lock(slot->mutex);
    item.error = std::string(slot->error.message());
  }
  return health;
}

}  // namespace argmesh
