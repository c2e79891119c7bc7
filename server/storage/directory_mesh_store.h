// Meshes as files: blobs/<first two digits>/<sha256>.
//
// A mesh is written below incoming/, synced, renamed to its place, and the
// folder synced, in this order. One process (the data directory's lock).
#ifndef ARGMESH_SERVER_STORAGE_DIRECTORY_MESH_STORE_H_
#define ARGMESH_SERVER_STORAGE_DIRECTORY_MESH_STORE_H_

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/engine/mesh_store.h"
#include "server/storage/data_directory.h"

namespace argmesh {

class DirectoryMeshStore : public MeshStore {
 public:
  // Removes what unfinished writes left below incoming/.
  static absl::StatusOr<std::unique_ptr<DirectoryMeshStore>> Open(
      std::shared_ptr<DataDirectory> directory);
  ~DirectoryMeshStore() override;

  absl::StatusOr<std::unique_ptr<MeshWriter>> StartWrite(
      int64_t expected_bytes) override;
  absl::StatusOr<std::unique_ptr<MeshReader>> Open(
      const Sha256Digest& sha256) const override;
  absl::Status RemoveUnreferenced(const Sha256Digest& sha256,
                                  const IsReferenced& is_referenced) override;
  absl::StatusOr<int64_t> Sweep(absl::Time older_than,
                                const IsReferenced& is_referenced) override;

  // While what it returns lives no mesh is removed; what would have been is
  // when the last of them goes.
  MeshPin HoldRemovals();

 private:
  struct Shared;  // what staged meshes and pins keep alive

  explicit DirectoryMeshStore(std::shared_ptr<Shared> shared);

  std::shared_ptr<Shared> shared_;

  friend class FileStagedMesh;
  friend class FileMeshWriter;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_DIRECTORY_MESH_STORE_H_
