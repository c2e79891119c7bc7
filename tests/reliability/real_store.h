// A data directory with its meshes and its catalog, as a server has them open.
#ifndef ARGMESH_TESTS_RELIABILITY_REAL_STORE_H_
#define ARGMESH_TESTS_RELIABILITY_REAL_STORE_H_

#include <filesystem>
#include <memory>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/storage/data_directory.h"
#include "server/storage/directory_mesh_store.h"
#include "server/storage/sqlite_catalog.h"

namespace argmesh {

struct RealStore {
  std::shared_ptr<DataDirectory> directory;
  std::unique_ptr<DirectoryMeshStore> meshes;
  std::unique_ptr<SqliteCatalog> catalog;

  // As a server starts: also sweeps. The write-ahead log is moved back into
  // the database after a few operations already.
  static absl::StatusOr<RealStore> Open(const std::filesystem::path& path);

  // Database, checksums and meshes are as they must be; else what is not.
  absl::Status CheckWhole() const;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_RELIABILITY_REAL_STORE_H_
