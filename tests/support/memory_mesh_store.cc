#include "tests/support/memory_mesh_store.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"

namespace argmesh {

struct MemoryMeshStore::Shared {
  struct Mesh {
    std::string bytes;
    absl::Time written;
  };
  std::mutex mutex;
  std::map<Sha256Digest, Mesh> meshes;
  std::map<Sha256Digest, int> pins;
  bool full = false;
};

namespace {

using SharedPtr = std::shared_ptr<MemoryMeshStore::Shared>;

class MemoryStagedMesh : public StagedMesh {
 public:
  MemoryStagedMesh(SharedPtr shared, std::string bytes)
      : shared_(std::move(shared)),
        bytes_(std::move(bytes)),
        sha256_(ComputeSha256(bytes_)) {}

  const Sha256Digest& sha256() const override { return sha256_; }
  int64_t size_bytes() const override {
    return static_cast<int64_t>(bytes_.size());
  }
  absl::StatusOr<std::string> ReadAll() const override { return bytes_; }

  absl::StatusOr<MeshPin> Publish() override {
    const std::lock_guard lock(shared_->mutex);
    ++shared_->pins[sha256_];
    shared_->meshes[sha256_] = {bytes_, absl::Now()};
    return MeshPin(static_cast<const void*>(this),
                   [shared = shared_, sha256 = sha256_](const void*) {
                     const std::lock_guard unpin_lock(shared->mutex);
                     if (--shared->pins[sha256] == 0) {
                       shared->pins.erase(sha256);
                     }
                   });
  }

 private:
  SharedPtr shared_;
  std::string bytes_;
  Sha256Digest sha256_;
};

class MemoryMeshWriter : public MeshWriter {
 public:
  explicit MemoryMeshWriter(SharedPtr shared) : shared_(std::move(shared)) {}

  absl::Status Append(std::string_view bytes) override {
    bytes_.append(bytes);
    return absl::OkStatus();
  }
  absl::StatusOr<std::unique_ptr<StagedMesh>> Seal() override {
    return std::unique_ptr<StagedMesh>(
        std::make_unique<MemoryStagedMesh>(shared_, std::move(bytes_)));
  }

 private:
  SharedPtr shared_;
  std::string bytes_;
};

class MemoryMeshReader : public MeshReader {
 public:
  MemoryMeshReader(std::string bytes, const Sha256Digest& sha256)
      : bytes_(std::move(bytes)), sha256_(sha256) {}

  int64_t size_bytes() const override {
    return static_cast<int64_t>(bytes_.size());
  }
  absl::StatusOr<std::string> Read(int64_t max_bytes) override {
    const std::string piece =
        bytes_.substr(position_, static_cast<size_t>(max_bytes));
    position_ += piece.size();
    if (!piece.empty() && position_ == bytes_.size() &&
        ComputeSha256(bytes_) != sha256_) {
      return MakeError(ErrorReason::kStoredDataDamaged, "other bytes");
    }
    return piece;
  }

 private:
  std::string bytes_;
  Sha256Digest sha256_;
  size_t position_ = 0;
};

}  // namespace

MemoryMeshStore::MemoryMeshStore() : shared_(std::make_shared<Shared>()) {}

absl::StatusOr<std::unique_ptr<MeshWriter>> MemoryMeshStore::StartWrite(
    int64_t /*expected_bytes*/) {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->full) return MakeError(ErrorReason::kStoreFull, "full");
  return std::unique_ptr<MeshWriter>(
      std::make_unique<MemoryMeshWriter>(shared_));
}

absl::StatusOr<std::unique_ptr<MeshReader>> MemoryMeshStore::Open(
    const Sha256Digest& sha256) const {
  const std::lock_guard lock(shared_->mutex);
  const auto it = shared_->meshes.find(sha256);
  if (it == shared_->meshes.end()) {
    return MakeError(ErrorReason::kStoredDataDamaged, "the mesh is missing");
  }
  return std::unique_ptr<MeshReader>(
      std::make_unique<MemoryMeshReader>(it->second.bytes, sha256));
}

absl::Status MemoryMeshStore::RemoveUnreferenced(
    const Sha256Digest& sha256, const IsReferenced& is_referenced) {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->pins.contains(sha256)) return absl::OkStatus();
  ARGMESH_ASSIGN_OR_RETURN(const bool referenced, is_referenced(sha256));
  if (!referenced) shared_->meshes.erase(sha256);
  return absl::OkStatus();
}

absl::StatusOr<int64_t> MemoryMeshStore::Sweep(
    absl::Time older_than, const IsReferenced& is_referenced) {
  std::vector<Sha256Digest> old;
  {
    const std::lock_guard lock(shared_->mutex);
    for (const auto& [sha256, mesh] : shared_->meshes) {
      if (mesh.written < older_than) old.push_back(sha256);
    }
  }
  int64_t removed = 0;
  for (const Sha256Digest& sha256 : old) {
    ARGMESH_ASSIGN_OR_RETURN(const bool referenced, is_referenced(sha256));
    if (referenced) continue;
    ARGMESH_RETURN_IF_ERROR(RemoveUnreferenced(sha256, is_referenced));
    ++removed;
  }
  return removed;
}

std::unique_ptr<MemoryMeshStore> MemoryMeshStore::Copy() const {
  auto copy = std::make_unique<MemoryMeshStore>();
  const std::lock_guard lock(shared_->mutex);
  copy->shared_->meshes = shared_->meshes;
  return copy;
}

size_t MemoryMeshStore::size() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->meshes.size();
}

void MemoryMeshStore::Damage(const Sha256Digest& sha256) {
  const std::lock_guard lock(shared_->mutex);
  shared_->meshes[sha256].bytes.front() ^= 1;
}

void MemoryMeshStore::FillUp() {
  const std::lock_guard lock(shared_->mutex);
  shared_->full = true;
}

}  // namespace argmesh
