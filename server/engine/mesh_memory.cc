#include "server/engine/mesh_memory.h"

#include <chrono>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

constexpr int64_t kBytesPerFace = 150;
constexpr int64_t kBytesPerVertex = 370;
constexpr auto kLook = std::chrono::milliseconds(20);  // for a stop

}  // namespace

absl::StatusOr<MeshMemoryClaim> MeshMemory::Claim(int64_t vertices,
                                                  int64_t faces,
                                                  absl::Duration max_wait,
                                                  const StopToken& stop) {
  const int64_t bytes = kBytesPerVertex * vertices + kBytesPerFace * faces;
  if (bytes > budget_) {
    return MakeError(
        ErrorReason::kMeshTooLarge,
        absl::StrFormat("%d vertices and %d faces take about %d MiB to compute "
                        "with, more than %d",
                        vertices, faces, bytes >> 20, budget_ >> 20),
        {{"limit", absl::StrFormat("%d", budget_)}});
  }
  const absl::Time give_up = absl::Now() + max_wait;
  std::unique_lock lock(mutex_);
  while (claimed_ + bytes > budget_) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    if (absl::Now() >= give_up) {
      return WithRetryDelay(
          MakeError(ErrorReason::kOverloaded,
                    "other meshes take the memory that this one needs"),
          max_wait);
    }
    released_.wait_for(lock, kLook);
  }
  claimed_ += bytes;
  return MeshMemoryClaim(*this, bytes);
}

int64_t MeshMemory::claimed() const {
  const std::lock_guard lock(mutex_);
  return claimed_;
}

void MeshMemory::Release(int64_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    claimed_ -= bytes;
  }
  released_.notify_all();
}

MeshMemoryClaim::MeshMemoryClaim(MeshMemoryClaim&& other) noexcept
    : memory_(std::exchange(other.memory_, nullptr)),
      bytes_(std::exchange(other.bytes_, 0)) {}

MeshMemoryClaim& MeshMemoryClaim::operator=(MeshMemoryClaim&& other) noexcept {
  Release();
  memory_ = std::exchange(other.memory_, nullptr);
  bytes_ = std::exchange(other.bytes_, 0);
  return *this;
}

void MeshMemoryClaim::Release() {
  if (memory_ != nullptr) memory_->Release(bytes_);
  memory_ = nullptr;
  bytes_ = 0;
}

}  // namespace argmesh
