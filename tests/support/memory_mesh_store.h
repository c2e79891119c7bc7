// A MeshStore in memory, for tests of the engine and of the rpc layer. The
// port's own test suite runs against it as against the real one.
#ifndef ARGMESH_TESTS_SUPPORT_MEMORY_MESH_STORE_H_
#define ARGMESH_TESTS_SUPPORT_MEMORY_MESH_STORE_H_

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/engine/mesh_store.h"

namespace argmesh {

class MemoryMeshStore : public MeshStore {
 public:
  MemoryMeshStore();

  absl::StatusOr<std::unique_ptr<MeshWriter>> StartWrite(
      int64_t expected_bytes) override;
  absl::StatusOr<std::unique_ptr<MeshReader>> Open(
      const Sha256Digest& sha256) const override;
  absl::Status RemoveUnreferenced(const Sha256Digest& sha256,
                                  const IsReferenced& is_referenced) override;
  absl::StatusOr<int64_t> Sweep(absl::Time older_than,
                                const IsReferenced& is_referenced) override;

  // Another one with the same meshes.
  std::unique_ptr<MemoryMeshStore> Copy() const;
  // How many meshes are published.
  size_t size() const;
  // Makes the published bytes others than those of the name.
  void Damage(const Sha256Digest& sha256);
  // StartWrite answers STORE_FULL from now on.
  void FillUp();

  struct Shared;

 private:
  std::shared_ptr<Shared> shared_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_MEMORY_MESH_STORE_H_
