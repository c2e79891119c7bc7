#include "server/storage/catalog_rows.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/error_reason.h"
#include "server/engine/record_codec.h"

namespace argmesh {
namespace {

absl::Status ReadDetails(const SqliteStatement& row, ShapeRecord& record) {
  ARGMESH_ASSIGN_OR_RETURN(record.sha256, row.Digest(6));
  ARGMESH_ASSIGN_OR_RETURN(record.metadata, ParseMetadata(row.Text(12)));
  return ParseShapeDetails(row.Blob(13), record);
}

absl::Status ReadDeclarations(const SqliteStatement& row,
                              CollectionRecord& record) {
  ARGMESH_ASSIGN_OR_RETURN(record.settings,
                           ParseCollectionSettings(row.Blob(4)));
  const std::string keys = row.Blob(11);
  if (keys.empty()) return absl::OkStatus();  // from before there were any
  ARGMESH_ASSIGN_OR_RETURN(record.metadata_keys, ParseMetadataKeys(keys));
  return absl::OkStatus();
}

}  // namespace

absl::Status DamagedRow(std::string_view collection, std::string_view shape,
                        std::string_view why) {
  const std::string of(collection);
  const std::string name(shape);
  return MakeError(ErrorReason::kStoredDataDamaged,
                   "collection " + of +
                       (name.empty() ? "" : ", shape " + name) + ": " +
                       std::string(why),
                   {{"collection", of}, {"shape", name}});
}

absl::StatusOr<CollectionRow> ReadCollectionRow(const SqliteStatement& row) {
  CollectionRow found;
  found.number = row.Int(0);
  CollectionRecord& record = found.record;
  record.id = row.Text(1);
  record.uid = row.Text(2);
  record.display_name = row.Text(3);
  if (const absl::Status status = ReadDeclarations(row, record); !status.ok()) {
    return DamagedRow(record.id, "", std::string(status.message()));
  }
  record.graph_version = static_cast<uint32_t>(row.Int(5));
  record.generation = row.Int(6);
  record.shape_count = row.Int(7);
  record.revision = row.Int(8);
  record.create_time = absl::FromUnixMicros(row.Int(9));
  record.update_time = absl::FromUnixMicros(row.Int(10));
  return found;
}

absl::StatusOr<ShapeRow> ReadShapeRow(const SqliteStatement& row) {
  ShapeRow found;
  found.number = row.Int(0);
  ShapeRecord& record = found.record;
  record.collection = row.Text(1);
  record.id = row.Text(2);
  record.uid = row.Text(3);
  record.state = static_cast<ShapeState>(row.Int(4));
  record.error = row.Text(5);
  record.size_bytes = row.Int(7);
  record.format = static_cast<MeshFormat>(row.Int(8));
  record.mesh_stored = row.Int(9) != 0;
  record.display_name = row.Text(10);
  record.source_uri = row.Text(11);
  record.generation = row.Int(14);
  record.create_time = absl::FromUnixMicros(row.Int(15));
  record.update_time = absl::FromUnixMicros(row.Int(16));
  if (const absl::Status status = ReadDetails(row, record); !status.ok()) {
    return DamagedRow(record.collection, record.id,
                      std::string(status.message()));
  }
  return found;
}

absl::StatusOr<CollectionRow> FindCollectionRow(SqliteConnection& connection,
                                                std::string_view id) {
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement statement,
      connection.Query("SELECT " ARGMESH_COLLECTION_COLUMNS
                       " FROM collection c WHERE c.name = ?",
                       id));
  ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
  if (!row) return CollectionNotFoundError(id);
  return ReadCollectionRow(statement);
}

absl::StatusOr<CollectionRow> FindCollectionRow(SqliteConnection& connection,
                                                std::string_view id,
                                                std::string_view uid) {
  ARGMESH_ASSIGN_OR_RETURN(CollectionRow row,
                           FindCollectionRow(connection, id));
  if (row.record.uid != uid) return CollectionNotFoundError(id);
  return row;
}

absl::StatusOr<std::optional<ShapeRow>> FindShapeRow(
    SqliteConnection& connection, int64_t collection, std::string_view id) {
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement statement,
      connection.Query("SELECT " ARGMESH_SHAPE_COLUMNS
                       " FROM shape s JOIN collection c "
                       "ON c.id = s.collection_id "
                       "WHERE s.collection_id = ? AND s.name = ?",
                       collection, id));
  ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
  if (!row) return std::nullopt;
  ARGMESH_ASSIGN_OR_RETURN(ShapeRow shape, ReadShapeRow(statement));
  return shape;
}

absl::StatusOr<std::map<std::string, std::string>> ParseMetadata(
    const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return absl::DataLossError("metadata is no object");
  std::map<std::string, std::string> metadata;
  for (const auto& [key, value] : json.items()) {
    if (!value.is_string()) {
      return absl::DataLossError("a metadata value is no text");
    }
    metadata[key] = value.get<std::string>();
  }
  return metadata;
}

std::string SerializeMetadata(
    const std::map<std::string, std::string>& metadata) {
  // The engine lets only UTF-8 through; anything else is replaced, not thrown.
  return nlohmann::json(metadata).dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace argmesh
