// Other settings for a collection of MemoryCatalog.
#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "tests/support/memory_catalog.h"

namespace argmesh {

void MemoryCatalog::Shape::TakeStaged() {
  StagedDescription& description = staged->description;
  record.report = description.report;
  record.graph = description.summary;
  graph_version = description.stage.graph_version;
  graph = std::move(description.graph);
  labels = std::move(description.labels);
  damaged = false;
  staged.reset();
}

absl::StatusOr<MemoryCatalog::Collection*> MemoryCatalog::FindAtStage(
    std::string_view id, std::string_view uid, const SettingsStage& stage) {
  ARGMESH_ASSIGN_OR_RETURN(Collection * collection, Find(id, uid));
  if (collection->stage != stage) return OtherSettingsError(id);
  return collection;
}

absl::Status MemoryCatalog::BeginStage(std::string_view collection,
                                       std::string_view collection_uid,
                                       const SettingsStage& stage) {
  const std::lock_guard lock(mutex_);
  ARGMESH_ASSIGN_OR_RETURN(Collection * found,
                           Find(collection, collection_uid));
  if (found->stage == stage) return absl::OkStatus();
  for (auto& [id, shape] : found->shapes) shape.staged.reset();
  found->stage.reset();
  if (!MakeSameGraphs(stage.settings, found->record.settings)) {
    found->stage = stage;
  }
  return absl::OkStatus();
}

absl::Status MemoryCatalog::StageShape(const ShapeStaging& staging) {
  const std::lock_guard lock(mutex_);
  ARGMESH_ASSIGN_OR_RETURN(
      Collection * collection,
      FindAtStage(staging.collection, staging.collection_uid,
                  staging.description.stage));
  const auto it = collection->shapes.find(staging.id);
  if (it == collection->shapes.end()) {
    return ShapeNotFoundError(staging.collection, staging.id);
  }
  Shape& shape = it->second;
  ARGMESH_RETURN_IF_ERROR(CheckStagedMesh(staging.sha256, shape.record.sha256));
  shape.staged = Staged{staging.sha256, staging.description};
  return absl::OkStatus();
}

absl::StatusOr<std::vector<std::string>> MemoryCatalog::ListUnstaged(
    std::string_view collection_uid, std::string_view after_id,
    int limit) const {
  return Page<std::string>(
      collection_uid, after_id, limit,
      [](const Collection&, const Shape& shape) -> std::optional<std::string> {
        if (shape.IsStaged()) return std::nullopt;
        return shape.record.id;
      });
}

absl::StatusOr<std::vector<ScannedGraph>> MemoryCatalog::ScanStaged(
    std::string_view collection_uid, std::string_view after_id,
    int limit) const {
  return Page<ScannedGraph>(collection_uid, after_id, limit,
                            [](const Collection& collection,
                               Shape shape) -> std::optional<ScannedGraph> {
                              if (!shape.IsStaged()) return std::nullopt;
                              shape.TakeStaged();
                              ScannedGraph scanned = Scan(collection, shape);
                              scanned.settings = collection.stage->settings;
                              return scanned;
                            });
}

absl::StatusOr<std::optional<CollectionRecord>> MemoryCatalog::SwitchSettings(
    const SettingsSwitch& change) {
  const std::lock_guard lock(mutex_);
  ARGMESH_ASSIGN_OR_RETURN(
      Collection * collection,
      FindAtStage(change.collection, change.collection_uid, change.stage));
  for (const auto& [id, shape] : collection->shapes) {
    if (!shape.IsStaged()) return std::nullopt;
  }
  const int64_t generation =
      LogChange(*collection, "", ShapeChange::Kind::kSwitch);
  for (auto& [id, shape] : collection->shapes) {
    shape.TakeStaged();
    shape.record.generation = generation;
    shape.record.update_time = change.update_time;
  }
  collection->stage.reset();
  CollectionRecord& record = collection->record;
  record.settings = change.stage.settings;
  record.graph_version = change.stage.graph_version;
  record.update_time = change.update_time;
  ++record.revision;
  return record;
}

absl::Status MemoryCatalog::RemoveUnusedGraphs(const StopToken&) {
  return absl::OkStatus();  // nothing is left behind
}

absl::Status MemoryCatalog::ForgetChanges(const StopToken&) {
  return absl::OkStatus();  // it has been open for ever
}

}  // namespace argmesh
