#include "tests/reliability/real_store.h"

#include <utility>

#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/storage/storage_check.h"

namespace argmesh {

absl::StatusOr<RealStore> RealStore::Open(const std::filesystem::path& path) {
  RealStore store;
  ARGMESH_ASSIGN_OR_RETURN(
      store.directory,
      DataDirectory::Open(
          path, {.min_free_bytes = 0, .allow_network_file_system = true}));
  ARGMESH_ASSIGN_OR_RETURN(store.meshes,
                           DirectoryMeshStore::Open(store.directory));
  SqliteCatalogOptions options;
  options.writer.passive_checkpoint_bytes = 500'000;
  options.writer.truncate_checkpoint_bytes = 1'500'000;
  options.removed_at_once = 1;
  ARGMESH_ASSIGN_OR_RETURN(store.catalog,
                           SqliteCatalog::Open(store.directory, options));
  ARGMESH_RETURN_IF_ERROR(store.catalog->RemoveUnusedGraphs({}));
  RemovedShapes removed = {.more = true, .unreferenced = {}};
  while (removed.more) {
    ARGMESH_ASSIGN_OR_RETURN(removed, store.catalog->RemoveSomeDeleted());
  }
  ARGMESH_RETURN_IF_ERROR(store.meshes
                              ->Sweep(absl::Now(),
                                      [&store](const Sha256Digest& sha256) {
                                        return store.catalog->IsMeshReferenced(
                                            sha256);
                                      })
                              .status());
  return store;
}

absl::Status RealStore::CheckWhole() const {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::unique_ptr<SqliteConnection> connection,
      SqliteConnection::Open(directory->database_path(),
                             SqliteConnection::Mode::kReadOnly));
  ARGMESH_ASSIGN_OR_RETURN(
      const StorageReport report,
      CheckStorage(*connection, *meshes, /*collection=*/"", StopToken()));
  if (report.findings == 0) return absl::OkStatus();
  return absl::DataLossError(report.first_findings.front());
}

}  // namespace argmesh
