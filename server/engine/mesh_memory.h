// The memory that all meshes under computation may take together.
//
// What one takes is estimated from its counts: 150 bytes a face and 370 a
// vertex, measured on closed meshes and on soup (docs/operations.md). Files and
// parsed meshes come before that: one of each for every thread.
// Thread-safe.
#ifndef ARGMESH_SERVER_ENGINE_MESH_MEMORY_H_
#define ARGMESH_SERVER_ENGINE_MESH_MEMORY_H_

#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/stop_token.h"

namespace argmesh {

class MeshMemoryClaim;

class MeshMemory {
 public:
  explicit MeshMemory(int64_t budget) : budget_(budget) {}  // bytes, > 0

  // For a mesh of so many vertices and faces.
  //
  // Fails    MESH_TOO_LARGE  it takes more than all of the budget
  //          OVERLOADED      others took too much for `max_wait`
  //          kCancelled, kDeadlineExceeded of `stop`, within 20 ms
  absl::StatusOr<MeshMemoryClaim> Claim(int64_t vertices, int64_t faces,
                                        absl::Duration max_wait,
                                        const StopToken& stop);

  int64_t claimed() const;

 private:
  friend class MeshMemoryClaim;
  void Release(int64_t bytes);

  const int64_t budget_;
  mutable std::mutex mutex_;
  std::condition_variable released_;
  int64_t claimed_ = 0;
};

// Gives back what it claims when it goes. Must not outlive its MeshMemory.
class MeshMemoryClaim {
 public:
  MeshMemoryClaim() = default;  // of nothing
  ~MeshMemoryClaim() { Release(); }
  MeshMemoryClaim(MeshMemoryClaim&& other) noexcept;
  MeshMemoryClaim& operator=(MeshMemoryClaim&& other) noexcept;

  int64_t bytes() const { return bytes_; }

 private:
  friend class MeshMemory;
  MeshMemoryClaim(MeshMemory& memory, int64_t bytes)
      : memory_(&memory), bytes_(bytes) {}
  void Release();

  MeshMemory* memory_ = nullptr;
  int64_t bytes_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_MESH_MEMORY_H_
