// Rows of table mesh that no shape names any more.
#ifndef ARGMESH_SERVER_STORAGE_UNREFERENCED_MESH_H_
#define ARGMESH_SERVER_STORAGE_UNREFERENCED_MESH_H_

#include "absl/status/statusor.h"
#include "core/base/sha256.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

// Deletes the mesh's row unless a shape still names it; whether it went.
inline absl::StatusOr<bool> DeleteUnreferencedMesh(SqliteConnection& connection,
                                                   const Sha256Digest& sha256) {
  ARGMESH_ASSIGN_OR_RETURN(
      const int64_t gone,
      connection.Run("DELETE FROM mesh WHERE sha256 = ?1 AND NOT EXISTS "
                     "(SELECT 1 FROM shape WHERE mesh_sha256 = ?1)",
                     SqliteBlob(sha256)));
  return gone > 0;
}

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_UNREFERENCED_MESH_H_
