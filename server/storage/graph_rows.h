// Graphs of shapes with their face labels, as rows.
#ifndef ARGMESH_SERVER_STORAGE_GRAPH_ROWS_H_
#define ARGMESH_SERVER_STORAGE_GRAPH_ROWS_H_

#include <cstdint>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

struct GraphRow {
  uint32_t version = 0;
  std::string_view graph;
  std::string_view labels;  // compressed
  int64_t label_bytes = 0;  // before that
};

// The id it has. The shape does not refer to it by that.
absl::StatusOr<int64_t> InsertGraph(SqliteConnection& connection, int64_t shape,
                                    const GraphRow& row);
// With its labels, and with what is put aside for its shape if that is it.
absl::Status DeleteGraph(SqliteConnection& connection, int64_t graph);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_GRAPH_ROWS_H_
