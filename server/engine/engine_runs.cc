// The engine's long work.
#include <utility>

#include "absl/time/clock.h"
#include "core/base/identifier.h"
#include "core/base/status_macros.h"
#include "server/engine/engine.h"
#include "server/engine/engine_parts.h"
#include "server/engine/error_reason.h"
#include "server/engine/query_resolver.h"

namespace argmesh {

absl::StatusOr<ItemOutcome> Engine::Parts::DescribeAnew(
    const CollectionRecord& collection, const std::string& id,
    const StopToken& stop) {
  while (true) {
    absl::StatusOr<ShapeRecord> stored = catalog->GetShape(collection.id, id);
    absl::Status status = stored.status();
    if (stored.ok()) status = ingest.DescribeAnew(collection, *stored, stop);
    if (status.ok()) return ItemOutcome::kDone;
    if (absl::IsNotFound(status)) return ItemOutcome::kWasDone;  // deleted
    // The shape was updated meanwhile.
    if (ReasonOf(status) != ErrorReason::kEtagMismatch) return status;
  }
}

absl::StatusOr<CollectionRecord> Engine::CheckReindex(
    std::string_view id) const {
  ARGMESH_ASSIGN_OR_RETURN(CollectionRecord record, GetCollection(id));
  if (record.settings.store_meshes) return record;
  ShapeRecord any;
  any.collection = record.id;
  return MeshNotStoredError(any);
}

absl::StatusOr<RunReport> Engine::Reindex(const std::string& collection,
                                          const RunControl& control) {
  ARGMESH_ASSIGN_OR_RETURN(CollectionRecord record, CheckReindex(collection));
  if (record.graph_version != kShapeGraphVersion) {
    // From here on it takes shapes again.
    CollectionPatch patch;
    patch.id = collection;
    patch.graph_version = kShapeGraphVersion;
    patch.update_time = absl::Now();
    ARGMESH_ASSIGN_OR_RETURN(record, parts_->catalog->UpdateCollection(patch));
  }
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<std::string> outdated,
                           parts_->gallery.Outdated(collection));
  return RunItems(parts_->pool, outdated, control, [&](const std::string& id) {
    return parts_->DescribeAnew(record, id, control.stop);
  });
}

absl::StatusOr<RunReport> Engine::Import(const FolderImport& folder,
                                         const ImportSource& source,
                                         const RunControl& control) {
  ARGMESH_RETURN_IF_ERROR(GetCollection(folder.collection).status());
  ARGMESH_ASSIGN_OR_RETURN(std::vector<std::string> files,
                           source.ListFiles(folder.folder));
  std::erase_if(files, [](const std::string& file) {
    return MeshFormatFromPath(file) == MeshFormat::kUnknown;
  });
  const auto add = [&](const std::string& file) -> absl::StatusOr<ItemOutcome> {
    NewShape shape;
    shape.collection = folder.collection;
    shape.id = IdentifierFromPath(file);
    shape.source_uri = file;
    shape.format = MeshFormatFromPath(file);
    shape.if_exists = folder.if_exists;
    ARGMESH_ASSIGN_OR_RETURN(
        std::string bytes, source.Read(folder.folder, file,
                                       parts_->options.mesh_limits.max_bytes));
    ARGMESH_ASSIGN_OR_RETURN(const AddedShape added,
                             AddShape(shape, std::move(bytes), control.stop));
    return added.already_stored ? ItemOutcome::kWasDone : ItemOutcome::kDone;
  };
  return RunItems(parts_->pool, files, control, add);
}

}  // namespace argmesh
