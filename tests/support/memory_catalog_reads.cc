// The reads of shapes and graphs of MemoryCatalog.
#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/metadata_filter.h"
#include "server/engine/record_codec.h"
#include "tests/support/memory_catalog.h"

namespace argmesh {

absl::StatusOr<ShapeRecord> MemoryCatalog::GetShape(std::string_view collection,
                                                    std::string_view id) const {
  const std::lock_guard lock(mutex_);
  ARGMESH_ASSIGN_OR_RETURN(const Collection* found, Find(collection));
  const auto it = found->shapes.find(id);
  if (it == found->shapes.end()) return ShapeNotFoundError(collection, id);
  return it->second.record;
}

absl::StatusOr<std::vector<ShapeRecord>> MemoryCatalog::ListShapes(
    std::string_view collection, const ShapeSlice& slice) const {
  const std::lock_guard lock(mutex_);
  ARGMESH_ASSIGN_OR_RETURN(const Collection* found, Find(collection));
  ARGMESH_ASSIGN_OR_RETURN(
      const MetadataFilter filter,
      MetadataFilter::Parse(slice.filter, found->record.metadata_keys));
  std::vector<ShapeRecord> records;
  for (auto it = found->shapes.upper_bound(slice.after_id);
       it != found->shapes.end() &&
       static_cast<int>(records.size()) < slice.limit;
       ++it) {
    const ShapeRecord& record = it->second.record;
    if (filter.Matches(record.metadata)) records.push_back(record);
  }
  return records;
}

void MemoryCatalog::DamageGraph(std::string_view collection,
                                std::string_view id) {
  const std::lock_guard lock(mutex_);
  collections_.find(collection)->second.shapes.find(id)->second.damaged = true;
}

void MemoryCatalog::BeforeNextReadGraph(std::function<void()> act) {
  const std::lock_guard lock(mutex_);
  before_read_graph_ = std::move(act);
}

absl::StatusOr<StoredGraph> MemoryCatalog::ReadGraph(
    std::string_view collection, std::string_view id, bool with_labels) const {
  RunOnce(before_read_graph_);
  const std::lock_guard lock(mutex_);
  ARGMESH_ASSIGN_OR_RETURN(const Collection* found, Find(collection));
  const auto it = found->shapes.find(id);
  if (it == found->shapes.end()) return ShapeNotFoundError(collection, id);
  const ScannedGraph scanned = Scan(*found, it->second);
  ARGMESH_RETURN_IF_ERROR(scanned.status);
  return StoredGraph{
      scanned.record, scanned.settings,  scanned.graph_version,
      scanned.graph,  scanned.signature, with_labels ? it->second.labels : ""};
}

absl::StatusOr<std::vector<ScannedGraph>> MemoryCatalog::ScanGraphs(
    std::string_view collection_uid, std::string_view after_id,
    int limit) const {
  return Page<ScannedGraph>(
      collection_uid, after_id, limit,
      [](const Collection& collection, const Shape& shape) {
        return std::optional(Scan(collection, shape));
      });
}

absl::StatusOr<ScannedGraph> MemoryCatalog::FindGraph(
    std::string_view collection_uid, std::string_view id) const {
  const std::lock_guard lock(mutex_);
  if (closed_) return CatalogClosedError();
  const Collection* found = FindUid(collection_uid);
  if (found == nullptr || !found->shapes.contains(id)) {
    return ShapeNotFoundError(collection_uid, id);
  }
  return Scan(*found, found->shapes.find(id)->second);
}

absl::StatusOr<std::string> MemoryCatalog::ReadWindows(
    std::string_view collection_uid, std::string_view id) const {
  const std::lock_guard lock(mutex_);
  if (closed_) return CatalogClosedError();
  const Collection* found = FindUid(collection_uid);
  if (found == nullptr || !found->shapes.contains(id)) {
    return ShapeNotFoundError(collection_uid, id);
  }
  return found->shapes.find(id)->second.descriptors.windows;
}

absl::StatusOr<std::vector<ShapeChange>> MemoryCatalog::ReadChanges(
    std::string_view collection_uid, int64_t after_generation,
    int limit) const {
  const std::lock_guard lock(mutex_);
  if (closed_) return CatalogClosedError();
  std::vector<ShapeChange> changes;
  const Collection* found = FindUid(collection_uid);
  if (found == nullptr) return changes;
  for (const ShapeChange& change : found->changes) {
    if (change.generation > after_generation &&
        static_cast<int>(changes.size()) < limit) {
      changes.push_back(change);
    }
  }
  return changes;
}

absl::StatusOr<bool> MemoryCatalog::IsMeshReferenced(
    const Sha256Digest& sha256) const {
  const std::lock_guard lock(mutex_);
  if (closed_) return CatalogClosedError();
  return IsReferenced(sha256);
}

absl::StatusOr<std::optional<ShapeWritten>> MemoryCatalog::FindPutShape(
    const RequestStamp& request) const {
  const std::lock_guard lock(mutex_);
  if (closed_) return CatalogClosedError();
  ARGMESH_ASSIGN_OR_RETURN(const std::optional<std::string> answer,
                           Recall(request));
  if (!answer) return std::nullopt;
  return ParseShapeWritten(*answer);
}

}  // namespace argmesh
