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

absl::Status NoteOpening(SqliteConnection& connection) {
  return connection.Execute(
      "CREATE TEMP TABLE found AS SELECT id, generation FROM collection");
}

absl::StatusOr<bool> ForgetSomeChanges(SqliteConnection& connection) {
  ARGMESH_ASSIGN_OR_RETURN(
      const int64_t forgotten,
      connection.Run("DELETE FROM change_log WHERE (collection_id, generation) "
                     "IN (SELECT l.collection_id, l.generation FROM found f "
                     "JOIN change_log l ON l.collection_id = f.id "
                     "AND l.generation <= f.generation LIMIT ?)",
                     kChangesForgottenAtOnce));
  return forgotten > 0;
}

absl::StatusOr<bool> ForgetSomeChanges(SqliteConnection& connection,
                                       int64_t collection) {
  ARGMESH_ASSIGN_OR_RETURN(
      const int64_t forgotten,
      connection.Run("DELETE FROM change_log WHERE collection_id = ?1 AND "
                     "generation IN (SELECT generation FROM change_log "
                     "WHERE collection_id = ?1 LIMIT ?2)",
                     collection, kChangesForgottenAtOnce));
  return forgotten > 0;
}

}  // namespace argmesh
