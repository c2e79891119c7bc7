// Other settings for a collection in SQLite: stages, and the switch.
#include <algorithm>
#include <utility>

#include "absl/time/time.h"
#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/record_codec.h"
#include "server/storage/catalog_rows.h"
#include "server/storage/change_log.h"
#include "server/storage/graph_rows.h"
#include "server/storage/sqlite_catalog.h"
#include "server/storage/staged_rows.h"

namespace argmesh {
namespace {

// About what a row without a graph takes.
constexpr int64_t kStageRowBytes = 1024;
constexpr size_t kRemovedAtOnce = 64;

// Shapes s of collection c, and null t where nothing is put aside for the mesh.
#define ARGMESH_STAGED_JOIN                        \
  "FROM collection c "                             \
  "JOIN shape s ON s.collection_id = c.id "        \
  "LEFT JOIN staged_shape t ON t.shape_id = s.id " \
  "AND t.sha256 = s.sha256 "

absl::Status Begin(SqliteConnection& connection,
                   const CollectionRow& collection,
                   const SettingsStage& stage) {
  ARGMESH_ASSIGN_OR_RETURN(const std::optional<SettingsStage> begun,
                           ReadStage(connection, collection.number));
  if (begun == stage) return absl::OkStatus();
  ARGMESH_RETURN_IF_ERROR(ForgetStage(connection, collection.number));
  if (MakeSameGraphs(stage.settings, collection.record.settings)) {
    return absl::OkStatus();
  }
  const std::string settings = SerializeCollectionSettings(stage.settings);
  return connection
      .Run(
          "INSERT INTO stage (collection_id, settings, graph_version) "
          "VALUES (?, ?, ?)",
          collection.number, SqliteBlob(settings), stage.graph_version)
      .status();
}

// The collection, which has begun `stage` before.
absl::StatusOr<CollectionRow> FindStagedCollection(SqliteConnection& connection,
                                                   std::string_view id,
                                                   std::string_view uid,
                                                   const SettingsStage& stage) {
  ARGMESH_ASSIGN_OR_RETURN(CollectionRow row,
                           FindCollectionRow(connection, id, uid));
  ARGMESH_ASSIGN_OR_RETURN(const std::optional<SettingsStage> begun,
                           ReadStage(connection, row.number));
  if (begun != stage) return OtherSettingsError(id);
  return row;
}

absl::Status Stage(SqliteConnection& connection, const ShapeStaging& staging,
                   const StagedBytes& bytes) {
  ARGMESH_ASSIGN_OR_RETURN(
      const CollectionRow collection,
      FindStagedCollection(connection, staging.collection,
                           staging.collection_uid, staging.description.stage));
  ARGMESH_ASSIGN_OR_RETURN(
      const std::optional<ShapeRow> shape,
      FindShapeRow(connection, collection.number, staging.id));
  if (!shape) return ShapeNotFoundError(staging.collection, staging.id);
  ARGMESH_RETURN_IF_ERROR(
      CheckStagedMesh(staging.sha256, shape->record.sha256));
  return WriteStaged(connection, shape->number, staging.sha256,
                     staging.description, bytes);
}

// Every shape gets what is put aside for it.
absl::Status MoveShapes(SqliteConnection& connection, int64_t collection,
                        int64_t generation, absl::Time update_time) {
  return connection
      .Run(
          "UPDATE shape SET graph_id = t.graph_id, details = t.details, "
          "generation = ?, update_us = ? FROM staged_shape t "
          "WHERE t.shape_id = shape.id AND shape.collection_id = ?",
          generation, absl::ToUnixMicros(update_time), collection)
      .status();
}

absl::StatusOr<std::optional<CollectionRecord>> Switch(
    SqliteConnection& connection, const SettingsSwitch& change) {
  ARGMESH_ASSIGN_OR_RETURN(
      const CollectionRow collection,
      FindStagedCollection(connection, change.collection, change.collection_uid,
                           change.stage));
  ARGMESH_ASSIGN_OR_RETURN(
      const int64_t missing,
      connection.QueryInt("SELECT EXISTS (SELECT 1 " ARGMESH_STAGED_JOIN
                          "WHERE c.id = ? AND t.shape_id IS NULL)",
                          collection.number));
  if (missing != 0) return std::nullopt;
  ARGMESH_ASSIGN_OR_RETURN(const int64_t generation,
                           LogChange(connection, collection.number, "",
                                     ShapeChange::Kind::kSwitch, 0));
  ARGMESH_RETURN_IF_ERROR(MoveShapes(connection, collection.number, generation,
                                     change.update_time));
  ARGMESH_RETURN_IF_ERROR(ForgetStage(connection, collection.number));
  const std::string settings =
      SerializeCollectionSettings(change.stage.settings);
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("UPDATE collection SET settings = ?, graph_version = ?, "
               "update_us = ?, revision = revision + 1 WHERE id = ?",
               SqliteBlob(settings), change.stage.graph_version,
               absl::ToUnixMicros(change.update_time), collection.number)
          .status());
  ARGMESH_ASSIGN_OR_RETURN(CollectionRow switched,
                           FindCollectionRow(connection, change.collection));
  return std::move(switched.record);
}

// Ids of graphs that neither a shape nor what is put aside for it names.
absl::StatusOr<std::vector<int64_t>> UnusedGraphs(
    SqliteConnection& connection) {
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement rows,
      connection.Query(
          "SELECT g.id FROM graph g JOIN shape s ON s.id = g.shape_id "
          "WHERE s.graph_id IS NOT g.id AND NOT EXISTS "
          "(SELECT 1 FROM staged_shape t WHERE t.graph_id = g.id)"));
  std::vector<int64_t> graphs;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const bool row, rows.Step());
    if (!row) return graphs;
    graphs.push_back(rows.Int(0));
  }
}

}  // namespace

absl::Status SqliteCatalog::BeginStage(std::string_view collection,
                                       std::string_view collection_uid,
                                       const SettingsStage& stage) {
  ARGMESH_ASSIGN_OR_RETURN(const SpaceClaim space, ClaimSpace(kStageRowBytes));
  return writer_.Write(
      kStageRowBytes, [&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(
            const CollectionRow row,
            FindCollectionRow(connection, collection, collection_uid));
        return Begin(connection, row, stage);
      });
}

absl::Status SqliteCatalog::StageShape(const ShapeStaging& staging) {
  ARGMESH_ASSIGN_OR_RETURN(const StagedBytes bytes,
                           MakeStagedBytes(staging.description));
  const auto size = static_cast<int64_t>(staging.description.graph.size() +
                                         bytes.labels.size()) +
                    kStageRowBytes;
  ARGMESH_ASSIGN_OR_RETURN(const SpaceClaim space, ClaimSpace(size));
  return writer_.Write(size, [&](SqliteConnection& connection) {
    return Stage(connection, staging, bytes);
  });
}

absl::StatusOr<std::vector<std::string>> SqliteCatalog::ListUnstaged(
    std::string_view collection_uid, std::string_view after_id,
    int limit) const {
  std::vector<std::string> ids;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(
            SqliteStatement rows,
            connection.Query("SELECT s.name " ARGMESH_STAGED_JOIN
                             "WHERE c.uid = ? AND s.name > ? "
                             "AND t.shape_id IS NULL ORDER BY s.name LIMIT ?",
                             collection_uid, after_id, limit));
        while (true) {
          ARGMESH_ASSIGN_OR_RETURN(const bool row, rows.Step());
          if (!row) return absl::OkStatus();
          ids.push_back(rows.Text(0));
        }
      }));
  return ids;
}

absl::StatusOr<std::optional<CollectionRecord>> SqliteCatalog::SwitchSettings(
    const SettingsSwitch& change) {
  ARGMESH_ASSIGN_OR_RETURN(const SpaceClaim space, ClaimSpace(kStageRowBytes));
  absl::StatusOr<std::optional<CollectionRecord>> switched;
  ARGMESH_RETURN_IF_ERROR(
      writer_.Write(kStageRowBytes, [&](SqliteConnection& connection) {
        switched = Switch(connection, change);
        return switched.status();
      }));
  return switched;
}

absl::Status SqliteCatalog::RemoveUnusedGraphs(const StopToken& stop) {
  absl::StatusOr<std::vector<int64_t>> unused;
  ARGMESH_RETURN_IF_ERROR(readers_.Read([&](SqliteConnection& connection) {
    unused = UnusedGraphs(connection);
    return unused.status();
  }));
  for (size_t begin = 0; begin < unused->size(); begin += kRemovedAtOnce) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    const size_t end = std::min(unused->size(), begin + kRemovedAtOnce);
    ARGMESH_RETURN_IF_ERROR(
        writer_.Write(kStageRowBytes, [&](SqliteConnection& connection) {
          absl::Status status;
          for (size_t i = begin; i < end && status.ok(); ++i) {
            status = DeleteGraph(connection, (*unused)[i]);
          }
          return status;
        }));
  }
  return absl::OkStatus();
}

}  // namespace argmesh
