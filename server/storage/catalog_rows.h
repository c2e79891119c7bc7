// Rows of the catalog's tables as records, and back.
#ifndef ARGMESH_SERVER_STORAGE_CATALOG_ROWS_H_
#define ARGMESH_SERVER_STORAGE_CATALOG_ROWS_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/engine/collection_record.h"
#include "server/engine/shape_record.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

// A record with the number its row has.
struct CollectionRow {
  int64_t number = 0;
  CollectionRecord record;
};
struct ShapeRow {
  int64_t number = 0;
  ShapeRecord record;
};

// Begins the name and the uid of a collection that is deleted and has shapes
// left (SqliteCatalog::RemoveSomeDeleted); comes after all that ids are made
// of.
#define ARGMESH_DELETED "'~'"

// The columns that ReadCollectionRow and ReadShapeRow expect from column 0 on;
// of shape s and collection c. Then come columns of the query's own.
#define ARGMESH_COLLECTION_COLUMNS                                      \
  "c.id, c.name, c.uid, c.display_name, c.settings, c.graph_version, "  \
  "c.generation, c.shape_count, c.revision, c.create_us, c.update_us, " \
  "c.metadata_keys"
#define ARGMESH_SHAPE_COLUMNS_WITH(details)                                 \
  "s.id, c.name, s.name, s.uid, s.state, s.error, s.sha256, s.size_bytes, " \
  "s.format, s.mesh_sha256 IS NOT NULL, s.display_name, s.source_uri, "     \
  "s.metadata, " details ", s.generation, s.create_us, s.update_us"
#define ARGMESH_SHAPE_COLUMNS ARGMESH_SHAPE_COLUMNS_WITH("s.details")
inline constexpr int kShapeColumns = 17;

// STORED_DATA_DAMAGED.
absl::StatusOr<CollectionRow> ReadCollectionRow(const SqliteStatement& row);
absl::StatusOr<ShapeRow> ReadShapeRow(const SqliteStatement& row);

// kCollectionNotFound.
absl::StatusOr<CollectionRow> FindCollectionRow(SqliteConnection& connection,
                                                std::string_view id);
// Also when another collection took the id of the one with `uid`.
absl::StatusOr<CollectionRow> FindCollectionRow(SqliteConnection& connection,
                                                std::string_view id,
                                                std::string_view uid);
// None: the collection has no such shape.
absl::StatusOr<std::optional<ShapeRow>> FindShapeRow(
    SqliteConnection& connection, int64_t collection, std::string_view id);
// Metadata as its column has it.
absl::StatusOr<std::map<std::string, std::string>> ParseMetadata(
    const std::string& text);
std::string SerializeMetadata(
    const std::map<std::string, std::string>& metadata);

// The error of a row that cannot be read.
absl::Status DamagedRow(std::string_view collection, std::string_view shape,
                        std::string_view why);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_CATALOG_ROWS_H_
