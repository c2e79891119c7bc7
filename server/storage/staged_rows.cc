#include "server/storage/staged_rows.h"

#include "core/base/status_macros.h"
#include "server/engine/record_codec.h"
#include "server/storage/graph_rows.h"
#include "server/storage/label_compression.h"

namespace argmesh {

absl::StatusOr<StagedBytes> MakeStagedBytes(
    const StagedDescription& description) {
  StagedBytes bytes;
  ARGMESH_ASSIGN_OR_RETURN(bytes.labels, CompressLabels(description.labels));
  ShapeRecord described;
  described.report = description.report;
  described.graph = description.summary;
  bytes.details = SerializeShapeDetails(described);
  return bytes;
}

absl::StatusOr<std::optional<SettingsStage>> ReadStage(
    SqliteConnection& connection, int64_t collection) {
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement row,
      connection.Query("SELECT settings, graph_version FROM stage "
                       "WHERE collection_id = ?",
                       collection));
  ARGMESH_ASSIGN_OR_RETURN(const bool found, row.Step());
  if (!found) return std::nullopt;
  SettingsStage stage;
  ARGMESH_ASSIGN_OR_RETURN(stage.settings,
                           ParseCollectionSettings(row.Blob(0)));
  stage.graph_version = static_cast<uint32_t>(row.Int(1));
  return stage;
}

absl::Status WriteStaged(SqliteConnection& connection, int64_t shape,
                         const Sha256Digest& mesh,
                         const StagedDescription& description,
                         const StagedBytes& bytes) {
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("DELETE FROM graph WHERE id = "
               "(SELECT graph_id FROM staged_shape WHERE shape_id = ?)",
               shape)
          .status());
  ARGMESH_ASSIGN_OR_RETURN(
      const int64_t graph,
      InsertGraph(
          connection, shape,
          {.version = description.stage.graph_version,
           .graph = description.graph,
           .labels = bytes.labels,
           .label_bytes = static_cast<int64_t>(description.labels.size())}));
  return connection
      .Run(
          "INSERT INTO staged_shape (shape_id, sha256, graph_id, details) "
          "VALUES (?, ?, ?, ?)",
          shape, SqliteBlob(mesh), graph, SqliteBlob(bytes.details))
      .status();
}

absl::Status ForgetStage(SqliteConnection& connection, int64_t collection) {
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("DELETE FROM staged_shape WHERE shape_id IN "
               "(SELECT id FROM shape WHERE collection_id = ?)",
               collection)
          .status());
  return connection.Run("DELETE FROM stage WHERE collection_id = ?", collection)
      .status();
}

}  // namespace argmesh
