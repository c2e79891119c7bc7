// Collections in SQLite.
#include <set>
#include <utility>
#include <vector>

#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/record_codec.h"
#include "server/storage/catalog_rows.h"
#include "server/storage/change_log.h"
#include "server/storage/metadata_values.h"
#include "server/storage/request_memory.h"
#include "server/storage/sqlite_catalog.h"
#include "server/storage/unreferenced_mesh.h"

namespace argmesh {
namespace {

constexpr int64_t kCollectionBytes = 1024;

absl::StatusOr<CollectionRecord> Insert(SqliteConnection& connection,
                                        const CollectionRecord& record) {
  const absl::StatusOr<CollectionRow> taken =
      FindCollectionRow(connection, record.id);
  if (taken.ok()) return CollectionExistsError(record.id);
  if (!absl::IsNotFound(taken.status())) return taken.status();
  const std::string settings = SerializeCollectionSettings(record.settings);
  const std::string keys = SerializeMetadataKeys(record.metadata_keys);
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("INSERT INTO collection (name, uid, display_name, settings, "
               "metadata_keys, graph_version, revision, create_us, update_us) "
               "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
               record.id, record.uid, record.display_name, SqliteBlob(settings),
               SqliteBlob(keys), record.graph_version, record.revision,
               absl::ToUnixMicros(record.create_time),
               absl::ToUnixMicros(record.update_time))
          .status());
  ARGMESH_ASSIGN_OR_RETURN(CollectionRow inserted,
                           FindCollectionRow(connection, record.id));
  return std::move(inserted.record);
}

absl::StatusOr<CollectionRecord> Update(SqliteConnection& connection,
                                        const CollectionPatch& patch) {
  ARGMESH_ASSIGN_OR_RETURN(CollectionRow row,
                           FindCollectionRow(connection, patch.id));
  ARGMESH_RETURN_IF_ERROR(CheckEtag(patch.etag, CollectionEtag(row.record)));
  if (patch.metadata_keys) {
    row.record.metadata_keys = *patch.metadata_keys;
    ARGMESH_RETURN_IF_ERROR(RewriteMetadataValues(connection, row));
  }
  const std::string keys = SerializeMetadataKeys(row.record.metadata_keys);
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("UPDATE collection SET display_name = ?, metadata_keys = ?, "
               "graph_version = ?, update_us = ?, revision = revision + 1 "
               "WHERE id = ?",
               patch.display_name.value_or(row.record.display_name),
               SqliteBlob(keys),
               patch.graph_version.value_or(row.record.graph_version),
               absl::ToUnixMicros(patch.update_time), row.number)
          .status());
  ARGMESH_ASSIGN_OR_RETURN(CollectionRow updated,
                           FindCollectionRow(connection, patch.id));
  return std::move(updated.record);
}

// Removes shapes of a collection, at most so many, and the meshes that no other
// shape names; how many shapes.
absl::StatusOr<int64_t> RemoveShapes(SqliteConnection& connection,
                                     int64_t collection, int most,
                                     std::vector<Sha256Digest>& unreferenced) {
  ARGMESH_ASSIGN_OR_RETURN(SqliteStatement rows,
                           connection.Query("SELECT id, mesh_sha256 FROM shape "
                                            "WHERE collection_id = ? LIMIT ?",
                                            collection, most));
  std::vector<int64_t> shapes;
  std::set<Sha256Digest> meshes;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const bool row, rows.Step());
    if (!row) break;
    shapes.push_back(rows.Int(0));
    if (rows.IsNull(1)) continue;
    ARGMESH_ASSIGN_OR_RETURN(const Sha256Digest sha256, rows.Digest(1));
    meshes.insert(sha256);
  }
  for (const int64_t shape : shapes) {
    ARGMESH_RETURN_IF_ERROR(
        connection.Run("DELETE FROM shape WHERE id = ?", shape).status());
  }
  const auto removed = static_cast<int64_t>(shapes.size());
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("UPDATE collection SET shape_count = shape_count - ? "
               "WHERE id = ?",
               removed, collection)
          .status());
  for (const Sha256Digest& sha256 : meshes) {
    ARGMESH_ASSIGN_OR_RETURN(const bool gone,
                             DeleteUnreferencedMesh(connection, sha256));
    if (gone) unreferenced.push_back(sha256);
  }
  return removed;
}

absl::Status RemoveRow(SqliteConnection& connection, int64_t collection) {
  return connection.Run("DELETE FROM collection WHERE id = ?", collection)
      .status();
}

absl::StatusOr<CollectionDeleted> Delete(SqliteConnection& connection,
                                         const CollectionDelete& removal,
                                         int removed_at_once) {
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRow row,
                           FindCollectionRow(connection, removal.id));
  ARGMESH_RETURN_IF_ERROR(CheckEtag(removal.etag, CollectionEtag(row.record)));
  if (row.record.shape_count > 0 && !removal.force) {
    return CollectionNotEmptyError(removal.id);
  }
  CollectionDeleted deleted;
  deleted.uid = row.record.uid;
  if (row.record.shape_count > removed_at_once ||
      row.record.generation > kChangesForgottenAtOnce) {
    ARGMESH_RETURN_IF_ERROR(
        connection
            .Run("UPDATE collection SET name = " ARGMESH_DELETED " || uid, "
                 "uid = " ARGMESH_DELETED " || uid WHERE id = ?",
                 row.number)
            .status());
    return deleted;
  }
  ARGMESH_RETURN_IF_ERROR(RemoveShapes(connection, row.number, removed_at_once,
                                       deleted.unreferenced)
                              .status());
  ARGMESH_RETURN_IF_ERROR(RemoveRow(connection, row.number));
  return deleted;
}

// The number of a deleted collection that is not removed yet; none: 0.
absl::StatusOr<int64_t> FindDeleted(SqliteConnection& connection) {
  return connection.QueryInt(
      "SELECT COALESCE((SELECT id FROM collection "
      "WHERE name >= " ARGMESH_DELETED " LIMIT 1), 0)");
}

// Some of what a deleted collection left; its row goes last.
absl::StatusOr<RemovedShapes> RemoveSome(SqliteConnection& connection,
                                         int64_t collection,
                                         int removed_at_once) {
  RemovedShapes removed = {.more = true, .unreferenced = {}};
  ARGMESH_ASSIGN_OR_RETURN(const int64_t shapes,
                           RemoveShapes(connection, collection, removed_at_once,
                                        removed.unreferenced));
  if (shapes > 0) return removed;
  ARGMESH_ASSIGN_OR_RETURN(const bool changes,
                           ForgetSomeChanges(connection, collection));
  if (!changes) {
    ARGMESH_RETURN_IF_ERROR(RemoveRow(connection, collection));
  }
  return removed;
}

}  // namespace

absl::StatusOr<CollectionRecord> SqliteCatalog::InsertCollection(
    const CollectionRecord& record, const RequestStamp& request) {
  ARGMESH_ASSIGN_OR_RETURN(const SpaceClaim space,
                           ClaimSpace(kCollectionBytes));
  absl::StatusOr<CollectionRecord> inserted;
  ARGMESH_RETURN_IF_ERROR(
      writer_.Write(kCollectionBytes, [&](SqliteConnection& connection) {
        inserted = WriteOnce(connection, request, ParseCollectionRecord,
                             SerializeCollectionRecord,
                             [&] { return Insert(connection, record); });
        return inserted.status();
      }));
  return inserted;
}

absl::StatusOr<CollectionRecord> SqliteCatalog::UpdateCollection(
    const CollectionPatch& patch) {
  ARGMESH_ASSIGN_OR_RETURN(const SpaceClaim space,
                           ClaimSpace(kCollectionBytes));
  absl::StatusOr<CollectionRecord> updated;
  ARGMESH_RETURN_IF_ERROR(
      writer_.Write(kCollectionBytes, [&](SqliteConnection& connection) {
        updated = WriteOnce(connection, patch.request, ParseCollectionRecord,
                            SerializeCollectionRecord,
                            [&] { return Update(connection, patch); });
        return updated.status();
      }));
  return updated;
}

absl::StatusOr<CollectionDeleted> SqliteCatalog::DeleteCollection(
    const CollectionDelete& removal) {
  absl::StatusOr<CollectionDeleted> deleted;
  ARGMESH_RETURN_IF_ERROR(
      writer_.Write(kCollectionBytes, [&](SqliteConnection& connection) {
        deleted = WriteOnce(
            connection, removal.request, ParseCollectionDeleted,
            SerializeCollectionDeleted,
            [&] { return Delete(connection, removal, removed_at_once_); });
        return deleted.status();
      }));
  return deleted;
}

absl::StatusOr<RemovedShapes> SqliteCatalog::RemoveSomeDeleted() {
  absl::StatusOr<int64_t> found;
  ARGMESH_RETURN_IF_ERROR(readers_.Read([&](SqliteConnection& connection) {
    found = FindDeleted(connection);
    return found.status();
  }));
  absl::StatusOr<RemovedShapes> removed = RemovedShapes{};
  if (*found == 0) return removed;
  ARGMESH_RETURN_IF_ERROR(
      writer_.Write(kCollectionBytes, [&](SqliteConnection& connection) {
        removed = RemoveSome(connection, *found, removed_at_once_);
        return removed.status();
      }));
  return removed;
}

absl::StatusOr<CollectionRecord> SqliteCatalog::GetCollection(
    std::string_view id) const {
  CollectionRecord record;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(CollectionRow row,
                                 FindCollectionRow(connection, id));
        record = std::move(row.record);
        return absl::OkStatus();
      }));
  return record;
}

absl::StatusOr<std::vector<CollectionRecord>> SqliteCatalog::ListCollections(
    std::string_view after_id, int limit) const {
  std::vector<CollectionRecord> records;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(
            SqliteStatement statement,
            connection.Query("SELECT " ARGMESH_COLLECTION_COLUMNS
                             " FROM collection c WHERE c.name > ? "
                             "AND c.name < " ARGMESH_DELETED
                             " ORDER BY c.name LIMIT ?",
                             after_id, limit));
        while (true) {
          ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
          if (!row) return absl::OkStatus();
          ARGMESH_ASSIGN_OR_RETURN(CollectionRow collection,
                                   ReadCollectionRow(statement));
          records.push_back(std::move(collection.record));
        }
      }));
  return records;
}

}  // namespace argmesh
