// Snapshots as files below snapshots/ of the data directory: ID.tar, and
// ID.tar.sha256 as sha256sum(1) writes and checks it.
#ifndef ARGMESH_SERVER_STORAGE_SNAPSHOT_DIRECTORY_H_
#define ARGMESH_SERVER_STORAGE_SNAPSHOT_DIRECTORY_H_

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "server/engine/store_admin.h"
#include "server/storage/data_directory.h"
#include "server/storage/directory_mesh_store.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

class SnapshotDirectory : public StoreAdmin {
 public:
  // `meshes` must outlive it. Removes what an unfinished snapshot left.
  static absl::StatusOr<std::unique_ptr<SnapshotDirectory>> Open(
      std::shared_ptr<DataDirectory> directory, DirectoryMeshStore& meshes);

  absl::StatusOr<SnapshotRecord> CreateSnapshot(std::string_view id,
                                                const StopToken& stop) override;
  absl::StatusOr<SnapshotRecord> GetSnapshot(
      std::string_view id) const override;
  absl::StatusOr<std::vector<SnapshotRecord>> ListSnapshots() const override;
  absl::StatusOr<std::unique_ptr<SnapshotReader>> OpenSnapshot(
      std::string_view id) const override;
  absl::Status DeleteSnapshot(std::string_view id) override;
  absl::StatusOr<StorageReport> Verify(std::string_view collection,
                                       const StopToken& stop) const override;

 private:
  SnapshotDirectory(std::shared_ptr<DataDirectory> directory,
                    DirectoryMeshStore& meshes)
      : directory_(std::move(directory)), meshes_(meshes) {}

  std::filesystem::path PathOf(std::string_view id) const;
  // Copies the catalog to `copy` and checks the copy.
  absl::StatusOr<std::unique_ptr<SqliteConnection>> CopyCatalog(
      const std::filesystem::path& copy, const StopToken& stop) const;
  absl::StatusOr<SnapshotRecord> Write(std::string_view id,
                                       const std::filesystem::path& copy,
                                       SqliteConnection& catalog,
                                       const StopToken& stop) const;

  const std::shared_ptr<DataDirectory> directory_;
  DirectoryMeshStore& meshes_;
  std::mutex create_mutex_;  // one at a time
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_SNAPSHOT_DIRECTORY_H_
