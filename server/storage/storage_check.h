// Reads everything stored and compares every checksum.
#ifndef ARGMESH_SERVER_STORAGE_STORAGE_CHECK_H_
#define ARGMESH_SERVER_STORAGE_STORAGE_CHECK_H_

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/sha256.h"
#include "core/base/stop_token.h"
#include "server/engine/mesh_store.h"
#include "server/engine/store_admin.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

// A row of table mesh.
struct NamedMesh {
  Sha256Digest sha256{};
  int64_t size_bytes = 0;
};

// Every mesh that the catalog names, or that shapes of `collection` name where
// it is not empty; by digest.
absl::StatusOr<std::vector<NamedMesh>> ReadNamedMeshes(
    SqliteConnection& connection, std::string_view collection);

// Reads one mesh to its end, handing out its pieces. STORED_DATA_DAMAGED when
// it is missing, or of other bytes or another size than `mesh` says.
absl::Status ReadWholeMesh(
    const MeshStore& meshes, const NamedMesh& mesh, const StopToken& stop,
    const std::function<absl::Status(std::string_view)>& piece);

// The database's structure, the checksum of every stored graph, label,
// signature and window, and every mesh; where `collection` is not empty, all
// but the structure, and of its shapes only. Findings go into the report; fails
// only when something cannot be read at all, there is no such collection
// (COLLECTION_NOT_FOUND), or `stop` says so.
absl::StatusOr<StorageReport> CheckStorage(SqliteConnection& connection,
                                           const MeshStore& meshes,
                                           std::string_view collection,
                                           const StopToken& stop);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_STORAGE_CHECK_H_
