#include "tests/support/memory_catalog.h"

#include <algorithm>

#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/error_reason.h"
#include "server/engine/record_codec.h"

namespace argmesh {
namespace {

// What PutShape answers without writing.
absl::StatusOr<std::optional<ShapeWritten>> AnswerStored(
    const ShapePut& put, const std::optional<ShapeRecord>& stored) {
  if (!stored) {
    if (put.etag.empty()) return std::nullopt;
    return ShapeNotFoundError(put.record.collection, put.record.id);
  }
  ARGMESH_RETURN_IF_ERROR(CheckEtag(put.etag, ShapeEtag(*stored)));
  if (put.if_exists == IfExists::kReplace) return std::nullopt;
  if (put.if_exists == IfExists::kReturnSame &&
      stored->sha256 == put.record.sha256) {
    return ShapeWritten{*stored, put.collection_uid, false, {}};
  }
  return ShapeExistsError(put.record.collection, put.record.id);
}

}  // namespace

std::unique_ptr<MemoryCatalog> MemoryCatalog::Copy() const {
  auto copy = std::make_unique<MemoryCatalog>();
  const std::lock_guard lock(mutex_);
  copy->collections_ = collections_;
  copy->answers_ = answers_;
  return copy;
}

absl::StatusOr<MemoryCatalog::Collection*> MemoryCatalog::Find(
    std::string_view id) {
  if (closed_) return CatalogClosedError();
  const auto it = collections_.find(id);
  if (it == collections_.end()) return CollectionNotFoundError(id);
  return &it->second;
}

absl::StatusOr<const MemoryCatalog::Collection*> MemoryCatalog::Find(
    std::string_view id) const {
  if (closed_) return CatalogClosedError();
  const auto it = collections_.find(id);
  if (it == collections_.end()) return CollectionNotFoundError(id);
  return &it->second;
}

absl::StatusOr<MemoryCatalog::Collection*> MemoryCatalog::Find(
    std::string_view id, std::string_view uid) {
  ARGMESH_ASSIGN_OR_RETURN(Collection * collection, Find(id));
  if (collection->record.uid != uid) return CollectionNotFoundError(id);
  return collection;
}

const MemoryCatalog::Collection* MemoryCatalog::FindUid(
    std::string_view uid) const {
  for (const auto& [id, collection] : collections_) {
    if (collection.record.uid == uid) return &collection;
  }
  return nullptr;
}

absl::StatusOr<std::optional<std::string>> MemoryCatalog::Recall(
    const RequestStamp& request) const {
  if (request.request_id.empty()) return std::nullopt;
  const auto it = answers_.find({request.principal, request.request_id});
  if (it == answers_.end() || it->second.request.expire_time <= absl::Now()) {
    return std::nullopt;
  }
  if (it->second.request.method != request.method ||
      it->second.request.hash != request.hash) {
    return RequestIdReusedError(request.request_id);
  }
  return it->second.bytes;
}

void MemoryCatalog::Remember(const RequestStamp& request, std::string answer) {
  if (request.request_id.empty()) return;
  answers_[{request.principal, request.request_id}] = {request,
                                                       std::move(answer)};
}

int64_t MemoryCatalog::LogChange(Collection& collection, const std::string& id,
                                 ShapeChange::Kind kind) {
  const int64_t generation = ++collection.record.generation;
  collection.changes.push_back({generation, id, kind});
  return generation;
}

bool MemoryCatalog::IsReferenced(const Sha256Digest& sha256) const {
  for (const auto& [id, collection] : collections_) {
    for (const auto& [name, shape] : collection.shapes) {
      if (shape.record.mesh_stored && shape.record.sha256 == sha256) {
        return true;
      }
    }
  }
  return false;
}

std::vector<Sha256Digest> MemoryCatalog::Unreferenced(
    const ShapeRecord& gone) const {
  if (!gone.mesh_stored || IsReferenced(gone.sha256)) return {};
  return {gone.sha256};
}

ScannedGraph MemoryCatalog::Scan(const Collection& collection,
                                 const Shape& shape) {
  ScannedGraph scanned;
  scanned.record = shape.record;
  scanned.settings = collection.record.settings;
  scanned.graph_version = shape.graph_version;
  if (shape.damaged) {
    scanned.status =
        MakeError(ErrorReason::kStoredDataDamaged, "the graph is damaged");
  } else {
    scanned.graph = shape.graph;
    scanned.signature = shape.descriptors.signature;
    scanned.window_words = shape.descriptors.window_words;
  }
  return scanned;
}

absl::StatusOr<CollectionRecord> MemoryCatalog::InsertCollection(
    const CollectionRecord& record, const RequestStamp& request) {
  const auto write = [&]() -> absl::StatusOr<CollectionRecord> {
    if (collections_.contains(record.id)) {
      return CollectionExistsError(record.id);
    }
    collections_[record.id].record = record;
    return record;
  };
  return Once<CollectionRecord>(request, ParseCollectionRecord,
                                SerializeCollectionRecord, write);
}

absl::StatusOr<CollectionRecord> MemoryCatalog::UpdateCollection(
    const CollectionPatch& patch) {
  const auto write = [&]() -> absl::StatusOr<CollectionRecord> {
    ARGMESH_ASSIGN_OR_RETURN(Collection * collection, Find(patch.id));
    CollectionRecord& record = collection->record;
    ARGMESH_RETURN_IF_ERROR(CheckEtag(patch.etag, CollectionEtag(record)));
    if (patch.metadata_keys) {
      for (const auto& [id, shape] : collection->shapes) {
        ARGMESH_RETURN_IF_ERROR(
            CheckStoredValues(*patch.metadata_keys, id, shape.record.metadata));
      }
      record.metadata_keys = *patch.metadata_keys;
    }
    if (patch.display_name) record.display_name = *patch.display_name;
    if (patch.graph_version) record.graph_version = *patch.graph_version;
    record.update_time = patch.update_time;
    ++record.revision;
    return record;
  };
  return Once<CollectionRecord>(patch.request, ParseCollectionRecord,
                                SerializeCollectionRecord, write);
}

absl::StatusOr<CollectionDeleted> MemoryCatalog::DeleteCollection(
    const CollectionDelete& removal) {
  const auto write = [&]() -> absl::StatusOr<CollectionDeleted> {
    ARGMESH_ASSIGN_OR_RETURN(const Collection* collection, Find(removal.id));
    ARGMESH_RETURN_IF_ERROR(
        CheckEtag(removal.etag, CollectionEtag(collection->record)));
    if (!collection->shapes.empty() && !removal.force) {
      return CollectionNotEmptyError(removal.id);
    }
    CollectionDeleted deleted;
    deleted.uid = collection->record.uid;
    const Collection gone = *collection;
    collections_.erase(removal.id);
    for (const auto& [id, shape] : gone.shapes) {
      for (const Sha256Digest& sha256 : Unreferenced(shape.record)) {
        deleted.unreferenced.push_back(sha256);
      }
    }
    std::sort(deleted.unreferenced.begin(), deleted.unreferenced.end());
    deleted.unreferenced.erase(
        std::unique(deleted.unreferenced.begin(), deleted.unreferenced.end()),
        deleted.unreferenced.end());
    return deleted;
  };
  return Once<CollectionDeleted>(removal.request, ParseCollectionDeleted,
                                 SerializeCollectionDeleted, write);
}

absl::StatusOr<RemovedShapes> MemoryCatalog::RemoveSomeDeleted() {
  return RemovedShapes{};  // nothing is left behind
}

absl::StatusOr<CollectionRecord> MemoryCatalog::GetCollection(
    std::string_view id) const {
  const std::lock_guard lock(mutex_);
  ARGMESH_ASSIGN_OR_RETURN(const Collection* collection, Find(id));
  return collection->record;
}

absl::StatusOr<std::vector<CollectionRecord>> MemoryCatalog::ListCollections(
    std::string_view after_id, int limit) const {
  const std::lock_guard lock(mutex_);
  if (closed_) return CatalogClosedError();
  std::vector<CollectionRecord> records;
  for (auto it = collections_.upper_bound(after_id);
       it != collections_.end() && static_cast<int>(records.size()) < limit;
       ++it) {
    records.push_back(it->second.record);
  }
  return records;
}

void MemoryCatalog::FailNextPut(absl::Status error) {
  const std::lock_guard lock(mutex_);
  next_put_ = std::move(error);
}

void MemoryCatalog::BeforeNextPut(std::function<void()> act) {
  const std::lock_guard lock(mutex_);
  before_put_ = std::move(act);
}

void MemoryCatalog::RunOnce(std::function<void()>& act) const {
  std::function<void()> taken;
  {
    const std::lock_guard lock(mutex_);
    taken = std::exchange(act, nullptr);
  }
  if (taken) taken();
}

absl::StatusOr<ShapeWritten> MemoryCatalog::PutShape(const ShapePut& put) {
  RunOnce(before_put_);
  const std::lock_guard lock(mutex_);
  if (closed_) return CatalogClosedError();
  ARGMESH_RETURN_IF_ERROR(std::exchange(next_put_, absl::OkStatus()));
  ARGMESH_ASSIGN_OR_RETURN(const std::optional<std::string> answer,
                           Recall(put.request));
  if (answer) return ParseShapeWritten(*answer);
  ARGMESH_ASSIGN_OR_RETURN(Collection * collection,
                           Find(put.record.collection, put.collection_uid));
  const auto it = collection->shapes.find(put.record.id);
  std::optional<ShapeRecord> replaced;
  if (it != collection->shapes.end()) replaced = it->second.record;
  ARGMESH_ASSIGN_OR_RETURN(std::optional<ShapeWritten> kept,
                           AnswerStored(put, replaced));
  if (kept) return *std::move(kept);
  if (!MakeSameGraphs(put.settings, collection->record.settings)) {
    return OtherSettingsError(put.record.collection);
  }
  ARGMESH_RETURN_IF_ERROR(CheckDeclaredValues(collection->record.metadata_keys,
                                              put.record.metadata));
  ShapeWritten written{put.record, put.collection_uid, true, {}};
  if (replaced) {
    written.record.uid = replaced->uid;
    written.record.create_time = replaced->create_time;
  }
  collection->record.shape_count += replaced ? 0 : 1;
  written.record.generation =
      LogChange(*collection, put.record.id, ShapeChange::Kind::kPut);
  std::optional<Staged>& staged = collection->shapes[put.record.id].staged;
  if (put.staged && collection->stage == put.staged->stage) {
    staged = Staged{put.record.sha256, *put.staged};
  }
  collection->shapes[put.record.id] = {
      written.record, put.graph_version, put.graph, put.labels, put.descriptors,
      false,          std::move(staged)};
  if (replaced) written.unreferenced = Unreferenced(*replaced);
  Remember(put.request, SerializeShapeWritten(written));
  return written;
}

absl::StatusOr<ShapeWritten> MemoryCatalog::UpdateShape(
    const ShapePatch& patch) {
  const auto write = [&]() -> absl::StatusOr<ShapeWritten> {
    ARGMESH_ASSIGN_OR_RETURN(Collection * collection, Find(patch.collection));
    const auto it = collection->shapes.find(patch.id);
    if (it == collection->shapes.end()) {
      return ShapeNotFoundError(patch.collection, patch.id);
    }
    ShapeRecord& record = it->second.record;
    ARGMESH_RETURN_IF_ERROR(CheckEtag(patch.etag, ShapeEtag(record)));
    if (patch.metadata) {
      ARGMESH_RETURN_IF_ERROR(CheckDeclaredValues(
          collection->record.metadata_keys, *patch.metadata));
    }
    if (patch.display_name) record.display_name = *patch.display_name;
    if (patch.source_uri) record.source_uri = *patch.source_uri;
    if (patch.metadata) record.metadata = *patch.metadata;
    record.update_time = patch.update_time;
    record.generation =
        LogChange(*collection, patch.id, ShapeChange::Kind::kPut);
    return ShapeWritten{record, collection->record.uid, true, {}};
  };
  return Once<ShapeWritten>(patch.request, ParseShapeWritten,
                            SerializeShapeWritten, write);
}

absl::StatusOr<ShapeDeleted> MemoryCatalog::DeleteShape(
    const ShapeDelete& removal) {
  const auto write = [&]() -> absl::StatusOr<ShapeDeleted> {
    ARGMESH_ASSIGN_OR_RETURN(Collection * collection, Find(removal.collection));
    const auto it = collection->shapes.find(removal.id);
    if (it == collection->shapes.end()) {
      return ShapeNotFoundError(removal.collection, removal.id);
    }
    ARGMESH_RETURN_IF_ERROR(
        CheckEtag(removal.etag, ShapeEtag(it->second.record)));
    return Erase(*collection, removal.id);
  };
  return Once<ShapeDeleted>(removal.request, ParseShapeDeleted,
                            SerializeShapeDeleted, write);
}

ShapeDeleted MemoryCatalog::Erase(Collection& collection,
                                  const std::string& id) {
  const auto it = collection.shapes.find(id);
  const ShapeRecord gone = it->second.record;
  collection.shapes.erase(it);
  --collection.record.shape_count;
  ShapeDeleted deleted;
  deleted.collection_uid = collection.record.uid;
  deleted.generation = LogChange(collection, id, ShapeChange::Kind::kDelete);
  deleted.unreferenced = Unreferenced(gone);
  return deleted;
}

absl::StatusOr<ShapeDeleted> MemoryCatalog::DeleteShapes(
    const ShapesDelete& removal) {
  const auto write = [&]() -> absl::StatusOr<ShapeDeleted> {
    ARGMESH_ASSIGN_OR_RETURN(Collection * collection, Find(removal.collection));
    for (const std::string& id : removal.ids) {
      if (!collection->shapes.contains(id)) {
        return ShapeNotFoundError(removal.collection, id);
      }
    }
    ShapeDeleted all{collection->record.uid, collection->record.generation, {}};
    for (const std::string& id : removal.ids) {
      const ShapeDeleted one = Erase(*collection, id);
      all.generation = one.generation;
      all.unreferenced.insert(all.unreferenced.end(), one.unreferenced.begin(),
                              one.unreferenced.end());
    }
    return all;
  };
  return Once<ShapeDeleted>(removal.request, ParseShapeDeleted,
                            SerializeShapeDeleted, write);
}

absl::Status MemoryCatalog::Close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  return absl::OkStatus();
}

}  // namespace argmesh
