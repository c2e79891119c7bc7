// Port: immutable mesh files under the SHA-256 of their bytes.
//
// A mesh is written in pieces to a place nobody sees (MeshWriter), sealed
// (StagedMesh), looked at, and only then published. What is dropped before
// that leaves nothing behind. Publishing is durable when it returns, so a
// catalog row that names the mesh is written after it.
//
// All classes: the store is thread-safe; a writer, a staged mesh and a reader
// belong to one thread at a time.
#ifndef ARGMESH_SERVER_ENGINE_MESH_STORE_H_
#define ARGMESH_SERVER_ENGINE_MESH_STORE_H_

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/sha256.h"

namespace argmesh {

// While one lives, the mesh it stands for is not removed: held from Publish
// until the row that names the mesh is committed.
using MeshPin = std::shared_ptr<const void>;

// A complete mesh that is not published yet; destroying it discards it.
class StagedMesh {
 public:
  virtual ~StagedMesh() = default;
  virtual const Sha256Digest& sha256() const = 0;
  virtual int64_t size_bytes() const = 0;
  virtual absl::StatusOr<std::string> ReadAll() const = 0;
  // Once. A mesh that is there already is kept; the result is the same.
  virtual absl::StatusOr<MeshPin> Publish() = 0;
};

class MeshWriter {
 public:
  virtual ~MeshWriter() = default;
  // As StartWrite when it is more than was expected.
  virtual absl::Status Append(std::string_view bytes) = 0;
  // Once; the writer must not be used afterwards.
  virtual absl::StatusOr<std::unique_ptr<StagedMesh>> Seal() = 0;
};

class MeshReader {
 public:
  virtual ~MeshReader() = default;
  virtual int64_t size_bytes() const = 0;
  // The next at most `max_bytes` bytes; empty at the end. The last piece
  // fails with kDataLoss STORED_DATA_DAMAGED when the digest is not the name.
  virtual absl::StatusOr<std::string> Read(int64_t max_bytes) = 0;
};

class MeshStore {
 public:
  // Whether a committed row names the mesh.
  using IsReferenced = std::function<absl::StatusOr<bool>(const Sha256Digest&)>;

  virtual ~MeshStore() = default;

  // Fails kResourceExhausted STORE_FULL when `expected_bytes` (0: unknown),
  // beside those of the writers there are, would eat into the space kept free.
  virtual absl::StatusOr<std::unique_ptr<MeshWriter>> StartWrite(
      int64_t expected_bytes) = 0;

  // Fails kDataLoss STORED_DATA_DAMAGED when the mesh is not there: the row
  // that names it says it is.
  virtual absl::StatusOr<std::unique_ptr<MeshReader>> Open(
      const Sha256Digest& sha256) const = 0;

  // Removes the mesh unless it is pinned or referenced; nobody can pin it
  // while `is_referenced` runs, which may be later, as long as the store lives.
  // A mesh that is not there is no error.
  virtual absl::Status RemoveUnreferenced(
      const Sha256Digest& sha256, const IsReferenced& is_referenced) = 0;

  // Removes what a crash left behind: unfinished writes, and meshes that are
  // not referenced, of before `older_than`. Returns how many files went.
  virtual absl::StatusOr<int64_t> Sweep(absl::Time older_than,
                                        const IsReferenced& is_referenced) = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_MESH_STORE_H_
