#include "server/storage/metadata_values.h"

#include <optional>
#include <variant>

#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"

namespace argmesh {
namespace {

absl::Status InsertValues(SqliteConnection& connection,
                          const CollectionRow& collection, int64_t shape,
                          const std::map<std::string, std::string>& metadata) {
  for (const MetadataKey& key : collection.record.metadata_keys) {
    const auto entry = metadata.find(key.key);
    if (entry == metadata.end()) continue;
    const std::optional<MetadataValue> value =
        ReadMetadataValue(key.type, entry->second);
    if (!value) continue;  // refused before it came here
    ARGMESH_ASSIGN_OR_RETURN(
        SqliteStatement insert,
        connection.Query("INSERT INTO metadata_value (collection_id, shape_id, "
                         "key, value) VALUES (?, ?, ?, ?)",
                         collection.number, shape, key.key));
    BindMetadataValue(*value, insert);
    ARGMESH_RETURN_IF_ERROR(insert.Step().status());
  }
  return absl::OkStatus();
}

// One row of RewriteMetadataValues: number, name, metadata.
absl::Status RewriteShape(SqliteConnection& connection,
                          const CollectionRow& collection,
                          const SqliteStatement& row) {
  const CollectionRecord& record = collection.record;
  const auto metadata = ParseMetadata(row.Text(2));
  if (!metadata.ok()) {
    return DamagedRow(record.id, row.Text(1),
                      std::string(metadata.status().message()));
  }
  ARGMESH_RETURN_IF_ERROR(
      CheckStoredValues(record.metadata_keys, row.Text(1), *metadata));
  return InsertValues(connection, collection, row.Int(0), *metadata);
}

}  // namespace

void BindMetadataValue(const MetadataValue& value, SqliteStatement& statement) {
  std::visit([&](const auto& of_type) { statement.Bind(of_type); }, value);
}

absl::Status WriteMetadataValues(
    SqliteConnection& connection, const CollectionRow& collection,
    int64_t shape, const std::map<std::string, std::string>& metadata) {
  ARGMESH_RETURN_IF_ERROR(
      connection.Run("DELETE FROM metadata_value WHERE shape_id = ?", shape)
          .status());
  return InsertValues(connection, collection, shape, metadata);
}

absl::Status RewriteMetadataValues(SqliteConnection& connection,
                                   const CollectionRow& collection) {
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("DELETE FROM metadata_value WHERE collection_id = ?",
               collection.number)
          .status());
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement row,
      connection.Query(
          "SELECT id, name, metadata FROM shape WHERE collection_id = ? "
          "ORDER BY name",
          collection.number));
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const bool found, row.Step());
    if (!found) return absl::OkStatus();
    ARGMESH_RETURN_IF_ERROR(RewriteShape(connection, collection, row));
  }
}

}  // namespace argmesh
