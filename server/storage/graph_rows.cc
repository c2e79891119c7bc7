#include "server/storage/graph_rows.h"

#include "core/base/crc32c.h"
#include "core/base/status_macros.h"

namespace argmesh {

absl::StatusOr<int64_t> InsertGraph(SqliteConnection& connection, int64_t shape,
                                    const GraphRow& row) {
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("INSERT INTO graph (shape_id, algorithm_version, arg, crc32c) "
               "VALUES (?, ?, ?, ?)",
               shape, row.version, SqliteBlob(row.graph),
               ComputeCrc32c(row.graph))
          .status());
  const int64_t graph = connection.last_insert_id();
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("INSERT INTO face_label (graph_id, raw_bytes, labels, crc32c) "
               "VALUES (?, ?, ?, ?)",
               graph, row.label_bytes, SqliteBlob(row.labels),
               ComputeCrc32c(row.labels))
          .status());
  return graph;
}

absl::Status DeleteGraph(SqliteConnection& connection, int64_t graph) {
  return connection.Run("DELETE FROM graph WHERE id = ?", graph).status();
}

}  // namespace argmesh
