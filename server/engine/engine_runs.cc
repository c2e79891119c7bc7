// The engine's long work.
#include <utility>

#include "core/base/identifier.h"
#include "core/base/status_macros.h"
#include "server/engine/engine.h"
#include "server/engine/engine_parts.h"
#include "server/engine/request_rules.h"

namespace argmesh {

absl::Status Engine::CheckReindex(
    std::string_view id,
    const std::optional<CollectionSettings>& settings) const {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", id));
  return parts_->reindexer.Check(id, settings).status();
}

absl::StatusOr<ReindexReport> Engine::Reindex(
    const std::string& collection,
    const std::optional<CollectionSettings>& settings,
    const RunControl& control) {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", collection));
  return parts_->reindexer.Run(collection, settings, control);
}

absl::StatusOr<RunReport> Engine::Import(const FolderImport& folder,
                                         const ImportSource& source,
                                         const RunControl& control) {
  ARGMESH_RETURN_IF_ERROR(GetCollection(folder.collection).status());
  ARGMESH_ASSIGN_OR_RETURN(std::vector<std::string> files,
                           source.ListFiles(folder.folder, control.stop));
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
