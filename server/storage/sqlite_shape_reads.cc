// Shapes and graphs in SQLite: reads.
#include <utility>

#include "core/base/crc32c.h"
#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/metadata_filter.h"
#include "server/engine/record_codec.h"
#include "server/storage/catalog_rows.h"
#include "server/storage/filter_condition.h"
#include "server/storage/label_compression.h"
#include "server/storage/request_memory.h"
#include "server/storage/sqlite_catalog.h"

namespace argmesh {
namespace {

// After the shape's columns: its graph and what else the index needs.
#define ARGMESH_GRAPH_COLUMNS_WITH(settings) \
  ", g.algorithm_version, g.arg, g.crc32c, " \
  "z.bytes, z.crc32c, w.words, w.words_crc32c, " settings " "
#define ARGMESH_GRAPH_COLUMNS ARGMESH_GRAPH_COLUMNS_WITH("c.settings")
#define ARGMESH_SURFACE_JOINS                   \
  "LEFT JOIN signature z ON z.shape_id = s.id " \
  "LEFT JOIN surface_windows w ON w.shape_id = s.id "
#define ARGMESH_GRAPH_JOINS \
  "LEFT JOIN graph g ON g.id = s.graph_id " ARGMESH_SURFACE_JOINS

// A blob and its checksum in the next column.
absl::StatusOr<std::string> CheckedBlob(const SqliteStatement& row, int column,
                                        const ShapeRecord& record) {
  std::string bytes = row.Blob(column);
  if (ComputeCrc32c(bytes) != row.Int(column + 1)) {
    return DamagedRow(record.collection, record.id,
                      "stored bytes fail their checksum");
  }
  return bytes;
}

absl::StatusOr<std::string> OptionalBlob(const SqliteStatement& row, int column,
                                         const ShapeRecord& record) {
  if (row.IsNull(column)) return std::string();
  return CheckedBlob(row, column, record);
}

absl::Status ReadGraphColumns(const SqliteStatement& row,
                              ScannedGraph& scanned) {
  const ShapeRecord& record = scanned.record;
  constexpr int kGraph = kShapeColumns + 1;
  const absl::StatusOr<CollectionSettings> settings =
      ParseCollectionSettings(row.Blob(kGraph + 6));
  if (!settings.ok()) {
    return DamagedRow(record.collection, "",
                      std::string(settings.status().message()));
  }
  scanned.settings = *settings;
  if (row.IsNull(kGraph)) {
    return DamagedRow(record.collection, record.id, "its graph is missing");
  }
  ARGMESH_ASSIGN_OR_RETURN(std::string graph, CheckedBlob(row, kGraph, record));
  ARGMESH_ASSIGN_OR_RETURN(std::string signature,
                           OptionalBlob(row, kGraph + 2, record));
  ARGMESH_ASSIGN_OR_RETURN(scanned.window_words,
                           OptionalBlob(row, kGraph + 4, record));
  scanned.graph = std::move(graph);
  scanned.signature = std::move(signature);
  return absl::OkStatus();
}

// A row of the shape's columns and the graph's.
ScannedGraph ReadScannedRow(const SqliteStatement& row) {
  ScannedGraph scanned;
  absl::StatusOr<ShapeRow> shape = ReadShapeRow(row);
  if (!shape.ok()) {
    scanned.record.collection = row.Text(1);
    scanned.record.id = row.Text(2);
    scanned.status = shape.status();
    return scanned;
  }
  scanned.record = std::move(shape->record);
  scanned.graph_version = static_cast<uint32_t>(row.Int(kShapeColumns));
  scanned.status = ReadGraphColumns(row, scanned);
  return scanned;
}

absl::Status ReadLabels(SqliteConnection& connection, int64_t shape,
                        StoredGraph& stored) {
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement row,
      connection.Query("SELECT l.raw_bytes, l.labels, l.crc32c FROM shape s "
                       "JOIN face_label l ON l.graph_id = s.graph_id "
                       "WHERE s.id = ?",
                       shape));
  ARGMESH_ASSIGN_OR_RETURN(const bool found, row.Step());
  const ShapeRecord& record = stored.record;
  if (!found) {
    return DamagedRow(record.collection, record.id, "its labels are missing");
  }
  ARGMESH_ASSIGN_OR_RETURN(const std::string compressed,
                           CheckedBlob(row, 1, record));
  absl::StatusOr<std::string> labels = DecompressLabels(compressed, row.Int(0));
  if (!labels.ok()) {
    return DamagedRow(record.collection, record.id,
                      std::string(labels.status().message()));
  }
  stored.labels = *std::move(labels);
  return absl::OkStatus();
}

absl::Status ReadStoredGraph(SqliteConnection& connection,
                             std::string_view collection, std::string_view id,
                             bool with_labels, StoredGraph& stored) {
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRow found,
                           FindCollectionRow(connection, collection));
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement row,
      connection.Query(
          "SELECT " ARGMESH_SHAPE_COLUMNS ARGMESH_GRAPH_COLUMNS "FROM shape s "
          "JOIN collection c ON c.id = s.collection_id " ARGMESH_GRAPH_JOINS
          "WHERE s.collection_id = ? AND s.name = ?",
          found.number, id));
  ARGMESH_ASSIGN_OR_RETURN(const bool has_row, row.Step());
  if (!has_row) return ShapeNotFoundError(collection, id);
  const int64_t shape = row.Int(0);
  ScannedGraph scanned = ReadScannedRow(row);
  ARGMESH_RETURN_IF_ERROR(scanned.status);
  stored.record = std::move(scanned.record);
  stored.settings = scanned.settings;
  stored.graph_version = scanned.graph_version;
  stored.graph = std::move(scanned.graph);
  stored.signature = std::move(scanned.signature);
  return with_labels ? ReadLabels(connection, shape, stored) : absl::OkStatus();
}

constexpr char kScan[] =
    "SELECT " ARGMESH_SHAPE_COLUMNS ARGMESH_GRAPH_COLUMNS
    "FROM collection c JOIN shape s ON s.collection_id = "
    "c.id " ARGMESH_GRAPH_JOINS
    "WHERE c.uid = ? AND s.name > ? ORDER BY s.name LIMIT ?";
// What is put aside, in place of what the shapes have.
constexpr char kScanStaged[] =
    "SELECT " ARGMESH_SHAPE_COLUMNS_WITH("t.details")
        ARGMESH_GRAPH_COLUMNS_WITH("e.settings")
    "FROM collection c JOIN stage e ON e.collection_id = c.id "
    "JOIN shape s ON s.collection_id = c.id "
    "JOIN staged_shape t ON t.shape_id = s.id AND t.sha256 = s.sha256 "
    "JOIN graph g ON g.id = t.graph_id " ARGMESH_SURFACE_JOINS
    "WHERE c.uid = ? AND s.name > ? ORDER BY s.name LIMIT ?";
constexpr char kFind[] =
    "SELECT " ARGMESH_SHAPE_COLUMNS ARGMESH_GRAPH_COLUMNS
    "FROM collection c JOIN shape s ON s.collection_id = "
    "c.id " ARGMESH_GRAPH_JOINS "WHERE c.uid = ? AND s.name = ?";

}  // namespace

absl::StatusOr<ShapeRecord> SqliteCatalog::GetShape(std::string_view collection,
                                                    std::string_view id) const {
  ShapeRecord record;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(const CollectionRow found,
                                 FindCollectionRow(connection, collection));
        ARGMESH_ASSIGN_OR_RETURN(std::optional<ShapeRow> shape,
                                 FindShapeRow(connection, found.number, id));
        if (!shape) return ShapeNotFoundError(collection, id);
        record = std::move(shape->record);
        return absl::OkStatus();
      }));
  return record;
}

absl::StatusOr<std::vector<ShapeRecord>> SqliteCatalog::ListShapes(
    std::string_view collection, const ShapeSlice& slice) const {
  std::vector<ShapeRecord> records;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(const CollectionRow found,
                                 FindCollectionRow(connection, collection));
        ARGMESH_ASSIGN_OR_RETURN(
            const MetadataFilter filter,
            MetadataFilter::Parse(slice.filter, found.record.metadata_keys));
        const FilterCondition condition(filter);
        ARGMESH_ASSIGN_OR_RETURN(
            SqliteStatement statement,
            connection.QueryOnce("SELECT " ARGMESH_SHAPE_COLUMNS
                                 " FROM shape s JOIN collection c "
                                 "ON c.id = s.collection_id "
                                 "WHERE s.collection_id = ? AND s.name > ? "
                                 "AND " +
                                 condition.sql() + " ORDER BY s.name LIMIT ?"));
        statement.Bind(found.number);
        statement.Bind(slice.after_id);
        condition.Bind(found.number, statement);
        statement.Bind(slice.limit);
        while (true) {
          ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
          if (!row) return absl::OkStatus();
          ARGMESH_ASSIGN_OR_RETURN(ShapeRow shape, ReadShapeRow(statement));
          records.push_back(std::move(shape.record));
        }
      }));
  return records;
}

absl::StatusOr<StoredGraph> SqliteCatalog::ReadGraph(
    std::string_view collection, std::string_view id, bool with_labels) const {
  StoredGraph stored;
  ARGMESH_RETURN_IF_ERROR(readers_.Read([&](SqliteConnection& connection) {
    return ReadStoredGraph(connection, collection, id, with_labels, stored);
  }));
  return stored;
}

absl::StatusOr<std::vector<ScannedGraph>> SqliteCatalog::Scan(
    std::string_view sql, std::string_view collection_uid,
    std::string_view after_id, int limit) const {
  std::vector<ScannedGraph> scanned;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(
            SqliteStatement statement,
            connection.Query(sql, collection_uid, after_id, limit));
        while (true) {
          ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
          if (!row) return absl::OkStatus();
          scanned.push_back(ReadScannedRow(statement));
        }
      }));
  return scanned;
}

absl::StatusOr<std::vector<ScannedGraph>> SqliteCatalog::ScanGraphs(
    std::string_view collection_uid, std::string_view after_id,
    int limit) const {
  return Scan(kScan, collection_uid, after_id, limit);
}

absl::StatusOr<std::vector<ScannedGraph>> SqliteCatalog::ScanStaged(
    std::string_view collection_uid, std::string_view after_id,
    int limit) const {
  return Scan(kScanStaged, collection_uid, after_id, limit);
}

absl::StatusOr<ScannedGraph> SqliteCatalog::FindGraph(
    std::string_view collection_uid, std::string_view id) const {
  ScannedGraph scanned;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(SqliteStatement statement,
                                 connection.Query(kFind, collection_uid, id));
        ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
        if (!row) return ShapeNotFoundError(collection_uid, id);
        scanned = ReadScannedRow(statement);
        return absl::OkStatus();
      }));
  return scanned;
}

absl::StatusOr<std::string> SqliteCatalog::ReadWindows(
    std::string_view collection_uid, std::string_view id) const {
  std::string windows;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(
            SqliteStatement row,
            connection.Query(
                "SELECT c.name, w.windows, w.windows_crc32c FROM collection c "
                "JOIN shape s ON s.collection_id = c.id "
                "LEFT JOIN surface_windows w ON w.shape_id = s.id "
                "WHERE c.uid = ? AND s.name = ?",
                collection_uid, id));
        ARGMESH_ASSIGN_OR_RETURN(const bool found, row.Step());
        if (!found) return ShapeNotFoundError(collection_uid, id);
        ShapeRecord record;
        record.collection = row.Text(0);
        record.id = id;
        ARGMESH_ASSIGN_OR_RETURN(windows, OptionalBlob(row, 1, record));
        return absl::OkStatus();
      }));
  return windows;
}

absl::StatusOr<std::vector<ShapeChange>> SqliteCatalog::ReadChanges(
    std::string_view collection_uid, int64_t after_generation,
    int limit) const {
  std::vector<ShapeChange> changes;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(
            SqliteStatement statement,
            connection.Query(
                "SELECT l.generation, l.name, l.kind FROM collection c "
                "JOIN change_log l ON l.collection_id = c.id "
                "WHERE c.uid = ? AND l.generation > ? "
                "ORDER BY l.generation LIMIT ?",
                collection_uid, after_generation, limit));
        while (true) {
          ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
          if (!row) return absl::OkStatus();
          changes.push_back({statement.Int(0), statement.Text(1),
                             static_cast<ShapeChange::Kind>(statement.Int(2))});
        }
      }));
  return changes;
}

absl::StatusOr<bool> SqliteCatalog::IsMeshReferenced(
    const Sha256Digest& sha256) const {
  bool referenced = false;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(
            SqliteStatement statement,
            connection.Query("SELECT 1 FROM mesh WHERE sha256 = ?",
                             SqliteBlob(sha256)));
        ARGMESH_ASSIGN_OR_RETURN(referenced, statement.Step());
        return absl::OkStatus();
      }));
  return referenced;
}

absl::StatusOr<std::optional<ShapeWritten>> SqliteCatalog::FindPutShape(
    const RequestStamp& request) const {
  std::optional<ShapeWritten> found;
  if (request.request_id.empty()) return found;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(const std::optional<std::string> answer,
                                 RecallRequest(connection, request));
        if (!answer) return absl::OkStatus();
        ARGMESH_ASSIGN_OR_RETURN(found, ParseShapeWritten(*answer));
        return absl::OkStatus();
      }));
  return found;
}

}  // namespace argmesh
