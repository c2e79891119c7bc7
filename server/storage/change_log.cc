#include "server/storage/change_log.h"

#include "core/base/status_macros.h"

namespace argmesh {

absl::StatusOr<int64_t> LogChange(SqliteConnection& connection,
                                  int64_t collection, const std::string& id,
                                  ShapeChange::Kind kind, int added) {
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("UPDATE collection SET generation = generation + 1, "
               "shape_count = shape_count + ? WHERE id = ?",
               added, collection)
          .status());
  ARGMESH_ASSIGN_OR_RETURN(
      const int64_t generation,
      connection.QueryInt("SELECT generation FROM collection WHERE id = ?",
                          collection));
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("INSERT INTO change_log (collection_id, generation, name, kind) "
               "VALUES (?, ?, ?, ?)",
               collection, generation, id, static_cast<int>(kind))
          .status());
  return generation;
}

}  // namespace argmesh
