// Shapes in SQLite: writes.
#include <utility>

#include "core/base/crc32c.h"
#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/record_codec.h"
#include "server/storage/catalog_rows.h"
#include "server/storage/change_log.h"
#include "server/storage/graph_rows.h"
#include "server/storage/label_compression.h"
#include "server/storage/metadata_values.h"
#include "server/storage/request_memory.h"
#include "server/storage/sqlite_catalog.h"
#include "server/storage/staged_rows.h"
#include "server/storage/unreferenced_mesh.h"

namespace argmesh {
namespace {

constexpr int64_t kShapeRowBytes = 2048;  // about what a shape's own row takes

// What PutShape writes beside the record, made before its turn comes.
struct PutBytes {
  std::string labels;  // compressed
  std::string details;
  std::string metadata;
  StagedBytes staged;

  int64_t size() const {
    return static_cast<int64_t>(labels.size() + details.size() +
                                metadata.size() + staged.labels.size() +
                                staged.details.size());
  }
};

absl::StatusOr<int64_t> WriteShapeRow(SqliteConnection& connection,
                                      int64_t collection,
                                      const ShapeRecord& record,
                                      const PutBytes& bytes,
                                      const std::optional<ShapeRow>& replaced) {
  std::optional<SqliteBlob> mesh;
  if (record.mesh_stored) {
    mesh = SqliteBlob(record.sha256);
    ARGMESH_RETURN_IF_ERROR(
        connection
            .Run("INSERT OR IGNORE INTO mesh (sha256, size_bytes, create_us) "
                 "VALUES (?, ?, ?)",
                 *mesh, record.size_bytes,
                 absl::ToUnixMicros(record.create_time))
            .status());
  }
  constexpr char kInsert[] =
      "INSERT INTO shape (state, error, sha256, size_bytes, format, "
      "mesh_sha256, display_name, source_uri, metadata, details, generation, "
      "update_us, create_us, uid, collection_id, name) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";
  constexpr char kUpdate[] =
      "UPDATE shape SET state = ?, error = ?, sha256 = ?, size_bytes = ?, "
      "format = ?, mesh_sha256 = ?, display_name = ?, source_uri = ?, "
      "metadata = ?, details = ?, generation = ?, update_us = ?, "
      "create_us = ?, uid = ? WHERE collection_id = ? AND name = ?";
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run(replaced ? kUpdate : kInsert, static_cast<int>(record.state),
               record.error, SqliteBlob(record.sha256), record.size_bytes,
               static_cast<int>(record.format), mesh, record.display_name,
               record.source_uri, bytes.metadata, SqliteBlob(bytes.details),
               record.generation, absl::ToUnixMicros(record.update_time),
               absl::ToUnixMicros(record.create_time), record.uid, collection,
               record.id)
          .status());
  return replaced ? replaced->number : connection.last_insert_id();
}

// In place of the graph that a replaced shape had.
absl::Status WriteGraph(SqliteConnection& connection, int64_t shape,
                        const ShapePut& put, const PutBytes& bytes) {
  ARGMESH_RETURN_IF_ERROR(connection
                              .Run("DELETE FROM graph WHERE id = "
                                   "(SELECT graph_id FROM shape WHERE id = ?)",
                                   shape)
                              .status());
  ARGMESH_ASSIGN_OR_RETURN(
      const int64_t graph,
      InsertGraph(connection, shape,
                  {.version = put.graph_version,
                   .graph = put.graph,
                   .labels = bytes.labels,
                   .label_bytes = static_cast<int64_t>(put.labels.size())}));
  return connection
      .Run("UPDATE shape SET graph_id = ? WHERE id = ?", graph, shape)
      .status();
}

// When the collection is at the stage it was made for.
absl::Status PutAside(SqliteConnection& connection, int64_t collection,
                      int64_t shape, const ShapePut& put,
                      const StagedBytes& bytes) {
  if (!put.staged) return absl::OkStatus();
  ARGMESH_ASSIGN_OR_RETURN(const std::optional<SettingsStage> stage,
                           ReadStage(connection, collection));
  if (stage != put.staged->stage) return absl::OkStatus();
  return WriteStaged(connection, shape, put.record.sha256, *put.staged, bytes);
}

// In place of what a replaced shape had.
absl::Status WriteDescriptors(SqliteConnection& connection, int64_t shape,
                              const SurfaceDescriptors& descriptors) {
  for (const char* forget :
       {"DELETE FROM signature WHERE shape_id = ?",
        "DELETE FROM surface_windows WHERE shape_id = ?"}) {
    ARGMESH_RETURN_IF_ERROR(connection.Run(forget, shape).status());
  }
  if (!descriptors.signature.empty()) {
    ARGMESH_RETURN_IF_ERROR(
        connection
            .Run("INSERT INTO signature (shape_id, bytes, crc32c) "
                 "VALUES (?, ?, ?)",
                 shape, SqliteBlob(descriptors.signature),
                 ComputeCrc32c(descriptors.signature))
            .status());
  }
  if (descriptors.windows.empty()) return absl::OkStatus();
  return connection
      .Run(
          "INSERT INTO surface_windows (shape_id, words, words_crc32c, "
          "windows, windows_crc32c) VALUES (?, ?, ?, ?, ?)",
          shape, SqliteBlob(descriptors.window_words),
          ComputeCrc32c(descriptors.window_words),
          SqliteBlob(descriptors.windows), ComputeCrc32c(descriptors.windows))
      .status();
}

// The mesh of a shape that was replaced or deleted, when it was the last.
absl::StatusOr<std::vector<Sha256Digest>> DropMesh(SqliteConnection& connection,
                                                   const ShapeRecord& gone) {
  std::vector<Sha256Digest> unreferenced;
  if (!gone.mesh_stored) return unreferenced;
  ARGMESH_ASSIGN_OR_RETURN(const bool dropped,
                           DeleteUnreferencedMesh(connection, gone.sha256));
  if (dropped) unreferenced.push_back(gone.sha256);
  return unreferenced;
}

// OK and no value: the shape is to be written.
absl::StatusOr<std::optional<ShapeWritten>> AnswerStored(
    const ShapePut& put, const std::optional<ShapeRow>& stored) {
  if (!stored) {
    if (put.etag.empty()) return std::nullopt;
    return ShapeNotFoundError(put.record.collection, put.record.id);
  }
  ARGMESH_RETURN_IF_ERROR(CheckEtag(put.etag, ShapeEtag(stored->record)));
  if (put.if_exists == IfExists::kReplace) return std::nullopt;
  if (put.if_exists == IfExists::kReturnSame &&
      stored->record.sha256 == put.record.sha256) {
    return ShapeWritten{stored->record, put.collection_uid, false, {}};
  }
  return ShapeExistsError(put.record.collection, put.record.id);
}

absl::StatusOr<ShapeWritten> Put(SqliteConnection& connection,
                                 const ShapePut& put, const PutBytes& bytes) {
  ARGMESH_ASSIGN_OR_RETURN(const std::optional<std::string> answer,
                           RecallRequest(connection, put.request));
  if (answer) return ParseShapeWritten(*answer);
  ARGMESH_ASSIGN_OR_RETURN(
      const CollectionRow collection,
      FindCollectionRow(connection, put.record.collection, put.collection_uid));
  ARGMESH_ASSIGN_OR_RETURN(
      const std::optional<ShapeRow> stored,
      FindShapeRow(connection, collection.number, put.record.id));
  ARGMESH_ASSIGN_OR_RETURN(std::optional<ShapeWritten> kept,
                           AnswerStored(put, stored));
  if (kept) return *std::move(kept);
  if (!MakeSameGraphs(put.settings, collection.record.settings)) {
    return OtherSettingsError(put.record.collection);
  }
  ARGMESH_RETURN_IF_ERROR(CheckDeclaredValues(collection.record.metadata_keys,
                                              put.record.metadata));

  ShapeWritten written{put.record, put.collection_uid, true, {}};
  ARGMESH_ASSIGN_OR_RETURN(
      written.record.generation,
      LogChange(connection, collection.number, put.record.id,
                ShapeChange::Kind::kPut, stored ? 0 : 1));
  if (stored) {
    written.record.uid = stored->record.uid;
    written.record.create_time = stored->record.create_time;
  }
  ARGMESH_ASSIGN_OR_RETURN(const int64_t shape,
                           WriteShapeRow(connection, collection.number,
                                         written.record, bytes, stored));
  ARGMESH_RETURN_IF_ERROR(
      WriteMetadataValues(connection, collection, shape, put.record.metadata));
  ARGMESH_RETURN_IF_ERROR(WriteGraph(connection, shape, put, bytes));
  ARGMESH_RETURN_IF_ERROR(WriteDescriptors(connection, shape, put.descriptors));
  ARGMESH_RETURN_IF_ERROR(
      PutAside(connection, collection.number, shape, put, bytes.staged));
  if (stored) {
    ARGMESH_ASSIGN_OR_RETURN(written.unreferenced,
                             DropMesh(connection, stored->record));
  }
  ARGMESH_RETURN_IF_ERROR(
      RememberRequest(connection, put.request, SerializeShapeWritten(written)));
  return written;
}

absl::StatusOr<ShapeWritten> Patch(SqliteConnection& connection,
                                   const ShapePatch& patch) {
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRow collection,
                           FindCollectionRow(connection, patch.collection));
  ARGMESH_ASSIGN_OR_RETURN(
      std::optional<ShapeRow> stored,
      FindShapeRow(connection, collection.number, patch.id));
  if (!stored) return ShapeNotFoundError(patch.collection, patch.id);
  ShapeRecord& record = stored->record;
  ARGMESH_RETURN_IF_ERROR(CheckEtag(patch.etag, ShapeEtag(record)));
  if (patch.display_name) record.display_name = *patch.display_name;
  if (patch.source_uri) record.source_uri = *patch.source_uri;
  if (patch.metadata) {
    ARGMESH_RETURN_IF_ERROR(
        CheckDeclaredValues(collection.record.metadata_keys, *patch.metadata));
    record.metadata = *patch.metadata;
    ARGMESH_RETURN_IF_ERROR(WriteMetadataValues(
        connection, collection, stored->number, record.metadata));
  }
  record.update_time = patch.update_time;
  ARGMESH_ASSIGN_OR_RETURN(record.generation,
                           LogChange(connection, collection.number, patch.id,
                                     ShapeChange::Kind::kPut, 0));
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("UPDATE shape SET display_name = ?, source_uri = ?, "
               "metadata = ?, generation = ?, update_us = ? WHERE id = ?",
               record.display_name, record.source_uri,
               SerializeMetadata(record.metadata), record.generation,
               absl::ToUnixMicros(record.update_time), stored->number)
          .status());
  return ShapeWritten{std::move(record), collection.record.uid, true, {}};
}

absl::StatusOr<ShapeDeleted> DeleteOne(SqliteConnection& connection,
                                       const CollectionRow& collection,
                                       const std::string& id,
                                       const std::string& etag) {
  ARGMESH_ASSIGN_OR_RETURN(const std::optional<ShapeRow> stored,
                           FindShapeRow(connection, collection.number, id));
  if (!stored) return ShapeNotFoundError(collection.record.id, id);
  ARGMESH_RETURN_IF_ERROR(CheckEtag(etag, ShapeEtag(stored->record)));
  ShapeDeleted deleted;
  deleted.collection_uid = collection.record.uid;
  ARGMESH_ASSIGN_OR_RETURN(deleted.generation,
                           LogChange(connection, collection.number, id,
                                     ShapeChange::Kind::kDelete, -1));
  ARGMESH_RETURN_IF_ERROR(
      connection.Run("DELETE FROM shape WHERE id = ?", stored->number)
          .status());
  ARGMESH_ASSIGN_OR_RETURN(deleted.unreferenced,
                           DropMesh(connection, stored->record));
  return deleted;
}

absl::StatusOr<ShapeDeleted> Delete(SqliteConnection& connection,
                                    const ShapeDelete& removal) {
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRow collection,
                           FindCollectionRow(connection, removal.collection));
  return DeleteOne(connection, collection, removal.id, removal.etag);
}

absl::StatusOr<ShapeDeleted> DeleteAll(SqliteConnection& connection,
                                       const ShapesDelete& removal) {
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRow row,
                           FindCollectionRow(connection, removal.collection));
  ShapeDeleted all{row.record.uid, row.record.generation, {}};
  for (const std::string& id : removal.ids) {
    ARGMESH_ASSIGN_OR_RETURN(const ShapeDeleted one,
                             DeleteOne(connection, row, id, ""));
    all.generation = one.generation;
    all.unreferenced.insert(all.unreferenced.end(), one.unreferenced.begin(),
                            one.unreferenced.end());
  }
  return all;
}

}  // namespace

absl::StatusOr<ShapeWritten> SqliteCatalog::PutShape(const ShapePut& put) {
  PutBytes bytes;
  ARGMESH_ASSIGN_OR_RETURN(bytes.labels, CompressLabels(put.labels));
  bytes.details = SerializeShapeDetails(put.record);
  bytes.metadata = SerializeMetadata(put.record.metadata);
  if (put.staged) {
    ARGMESH_ASSIGN_OR_RETURN(bytes.staged, MakeStagedBytes(*put.staged));
  }
  const auto size =
      static_cast<int64_t>(put.graph.size() +
                           (put.staged ? put.staged->graph.size() : 0) +
                           put.descriptors.signature.size() +
                           put.descriptors.window_words.size() +
                           put.descriptors.windows.size()) +
      bytes.size() + kShapeRowBytes;
  ARGMESH_ASSIGN_OR_RETURN(const SpaceClaim space, ClaimSpace(size));
  absl::StatusOr<ShapeWritten> written;
  ARGMESH_RETURN_IF_ERROR(
      writer_.Write(size, [&](SqliteConnection& connection) {
        written = Put(connection, put, bytes);
        return written.status();
      }));
  return written;
}

absl::StatusOr<ShapeWritten> SqliteCatalog::UpdateShape(
    const ShapePatch& patch) {
  const int64_t size =
      kShapeRowBytes +
      (patch.metadata
           ? static_cast<int64_t>(SerializeMetadata(*patch.metadata).size())
           : 0);
  ARGMESH_ASSIGN_OR_RETURN(const SpaceClaim space, ClaimSpace(size));
  absl::StatusOr<ShapeWritten> written;
  ARGMESH_RETURN_IF_ERROR(
      writer_.Write(size, [&](SqliteConnection& connection) {
        written = WriteOnce(connection, patch.request, ParseShapeWritten,
                            SerializeShapeWritten,
                            [&] { return Patch(connection, patch); });
        return written.status();
      }));
  return written;
}

absl::StatusOr<ShapeDeleted> SqliteCatalog::DeleteShape(
    const ShapeDelete& removal) {
  absl::StatusOr<ShapeDeleted> deleted;
  ARGMESH_RETURN_IF_ERROR(
      writer_.Write(kShapeRowBytes, [&](SqliteConnection& connection) {
        deleted = WriteOnce(connection, removal.request, ParseShapeDeleted,
                            SerializeShapeDeleted,
                            [&] { return Delete(connection, removal); });
        return deleted.status();
      }));
  return deleted;
}

absl::StatusOr<ShapeDeleted> SqliteCatalog::DeleteShapes(
    const ShapesDelete& removal) {
  absl::StatusOr<ShapeDeleted> deleted;
  ARGMESH_RETURN_IF_ERROR(
      writer_.Write(kShapeRowBytes, [&](SqliteConnection& connection) {
        deleted = WriteOnce(connection, removal.request, ParseShapeDeleted,
                            SerializeShapeDeleted,
                            [&] { return DeleteAll(connection, removal); });
        return deleted.status();
      }));
  return deleted;
}

}  // namespace argmesh
