#include "server/storage/directory_mesh_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/escaping.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/storage/posix_file.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

constexpr size_t kDigestDigits = 64;

absl::Status Damaged(const Sha256Digest& sha256, const char* what) {
  return MakeError(ErrorReason::kStoredDataDamaged,
                   absl::StrFormat("mesh %s %s", ToHex(sha256), what),
                   {{"sha256", ToHex(sha256)}});
}

// blobs/00 .. blobs/ff, all at once: a mesh's folder is durable before any
// mesh is published.
absl::Status MakeBlobFolders(const fs::path& blobs) {
  for (int i = 0; i < 256; ++i) {
    std::error_code error;
    fs::create_directory(blobs / absl::StrFormat("%02x", i), error);
    if (error) return FileError("mkdir", blobs, error.value());
  }
  return SyncDirectory(blobs);
}

// The digest that is a file's name; nothing for other names.
bool DigestOfName(const std::string& name, Sha256Digest& sha256) {
  if (name.size() != kDigestDigits ||
      name.find_first_not_of("0123456789abcdef") != std::string::npos) {
    return false;
  }
  const std::string bytes = absl::HexStringToBytes(name);
  std::copy(bytes.begin(), bytes.end(), sha256.begin());
  return true;
}

class FileMeshReader : public MeshReader {
 public:
  FileMeshReader(PosixFile file, fs::path path, Sha256Digest sha256,
                 int64_t size_bytes)
      : file_(std::move(file)),
        path_(std::move(path)),
        sha256_(sha256),
        size_bytes_(size_bytes) {}

  int64_t size_bytes() const override { return size_bytes_; }

  absl::StatusOr<std::string> Read(int64_t max_bytes) override {
    const int64_t count = std::min(max_bytes, size_bytes_ - position_);
    if (count <= 0) return std::string();
    ARGMESH_ASSIGN_OR_RETURN(std::string bytes,
                             ReadAt(file_, path_, position_, count));
    if (static_cast<int64_t>(bytes.size()) != count) {
      return Damaged(sha256_, "was cut short while it was read");
    }
    hasher_.Update(bytes);
    position_ += count;
    if (position_ == size_bytes_ && hasher_.Finish() != sha256_) {
      return Damaged(sha256_, "has other bytes than were stored");
    }
    return bytes;
  }

 private:
  PosixFile file_;
  fs::path path_;
  Sha256Digest sha256_;
  int64_t size_bytes_;
  int64_t position_ = 0;
  Sha256Hasher hasher_;
};

}  // namespace

struct DirectoryMeshStore::Shared {
  std::shared_ptr<DataDirectory> directory;
  std::atomic<int64_t> next_incoming{0};
  // Guards the pins; held over a removal, so that nothing is pinned in it.
  std::mutex mutex;
  std::map<Sha256Digest, int> pins;
  // Guarded too: those of HoldRemovals, and what waits for their end.
  int holds = 0;
  std::map<Sha256Digest, IsReferenced> released;

  fs::path PathOf(const Sha256Digest& sha256) const {
    const std::string name = ToHex(sha256);
    return directory->blobs_path() / name.substr(0, 2) / name;
  }

  // With the mutex.
  absl::Status Remove(const Sha256Digest& sha256,
                      const IsReferenced& is_referenced) const {
    if (pins.contains(sha256)) return absl::OkStatus();
    ARGMESH_ASSIGN_OR_RETURN(const bool referenced, is_referenced(sha256));
    if (referenced) return absl::OkStatus();
    const fs::path path = PathOf(sha256);
    if (::unlink(path.c_str()) == 0 || errno == ENOENT) return absl::OkStatus();
    return FileError("unlink", path, errno);
  }

  void EndHold() {
    const std::lock_guard lock(mutex);
    if (--holds > 0) return;
    // One that cannot be removed goes with the sweep of the next start.
    for (const auto& [sha256, is_referenced] : std::exchange(released, {})) {
      (void)Remove(sha256, is_referenced);
    }
  }

  void Unpin(const Sha256Digest& sha256) {
    const std::lock_guard lock(mutex);
    const auto it = pins.find(sha256);
    if (--it->second == 0) pins.erase(it);
  }
};

class FileStagedMesh : public StagedMesh {
 public:
  FileStagedMesh(std::shared_ptr<DirectoryMeshStore::Shared> shared,
                 PosixFile file, fs::path path, Sha256Digest sha256,
                 int64_t size_bytes)
      : shared_(std::move(shared)),
        file_(std::move(file)),
        path_(std::move(path)),
        sha256_(sha256),
        size_bytes_(size_bytes) {}
  ~FileStagedMesh() override {
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  const Sha256Digest& sha256() const override { return sha256_; }
  int64_t size_bytes() const override { return size_bytes_; }

  absl::StatusOr<std::string> ReadAll() const override {
    return ReadAt(file_, path_, 0, size_bytes_);
  }

  absl::StatusOr<MeshPin> Publish() override {
    ARGMESH_RETURN_IF_ERROR(SyncFile(file_, path_));
    MeshPin pin = Pin();
    const fs::path place = shared_->PathOf(sha256_);
    // Also over a mesh that is there already: the bytes are the same, unless
    // that one is damaged.
    if (std::rename(path_.c_str(), place.c_str()) != 0) {
      return FileError("rename", place, errno);
    }
    path_.clear();
    ARGMESH_RETURN_IF_ERROR(SyncDirectory(place.parent_path()));
    return pin;
  }

 private:
  MeshPin Pin() {
    const std::lock_guard lock(shared_->mutex);
    ++shared_->pins[sha256_];
    return MeshPin(static_cast<const void*>(this),
                   [shared = shared_, sha256 = sha256_](const void*) {
                     shared->Unpin(sha256);
                   });
  }

  std::shared_ptr<DirectoryMeshStore::Shared> shared_;
  PosixFile file_;
  fs::path path_;  // empty once it is published
  Sha256Digest sha256_;
  int64_t size_bytes_;
};

class FileMeshWriter : public MeshWriter {
 public:
  FileMeshWriter(std::shared_ptr<DirectoryMeshStore::Shared> shared,
                 PosixFile file, fs::path path, SpaceClaim announced)
      : shared_(std::move(shared)),
        file_(std::move(file)),
        path_(std::move(path)),
        announced_(std::move(announced)) {}
  ~FileMeshWriter() override {
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  absl::Status Append(std::string_view bytes) override {
    const auto count = static_cast<int64_t>(bytes.size());
    if (count > announced_.bytes()) {
      ARGMESH_ASSIGN_OR_RETURN(announced_, shared_->directory->Claim(count));
    }
    ARGMESH_RETURN_IF_ERROR(WriteAll(file_, path_, bytes));
    announced_.Wrote(count);
    hasher_.Update(bytes);
    size_bytes_ += count;
    return absl::OkStatus();
  }

  absl::StatusOr<std::unique_ptr<StagedMesh>> Seal() override {
    return std::unique_ptr<StagedMesh>(std::make_unique<FileStagedMesh>(
        shared_, std::move(file_), std::exchange(path_, fs::path()),
        hasher_.Finish(), size_bytes_));
  }

 private:
  std::shared_ptr<DirectoryMeshStore::Shared> shared_;
  PosixFile file_;
  fs::path path_;  // empty once it is sealed
  SpaceClaim announced_;
  Sha256Hasher hasher_;
  int64_t size_bytes_ = 0;
};

DirectoryMeshStore::DirectoryMeshStore(std::shared_ptr<Shared> shared)
    : shared_(std::move(shared)) {}
DirectoryMeshStore::~DirectoryMeshStore() {
  const std::lock_guard lock(shared_->mutex);
  shared_->released.clear();
}

absl::StatusOr<std::unique_ptr<DirectoryMeshStore>> DirectoryMeshStore::Open(
    std::shared_ptr<DataDirectory> directory) {
  std::error_code error;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(directory->incoming_path(), error)) {
    fs::remove(entry.path(), error);
  }
  if (error) {
    return FileError("clean up", directory->incoming_path(), error.value());
  }
  ARGMESH_RETURN_IF_ERROR(MakeBlobFolders(directory->blobs_path()));
  auto shared = std::make_shared<Shared>();
  shared->directory = std::move(directory);
  return std::unique_ptr<DirectoryMeshStore>(
      new DirectoryMeshStore(std::move(shared)));
}

absl::StatusOr<std::unique_ptr<MeshWriter>> DirectoryMeshStore::StartWrite(
    int64_t expected_bytes) {
  ARGMESH_ASSIGN_OR_RETURN(SpaceClaim announced,
                           shared_->directory->Claim(expected_bytes));
  fs::path path = shared_->directory->incoming_path() /
                  absl::StrFormat("%d", shared_->next_incoming++);
  ARGMESH_ASSIGN_OR_RETURN(PosixFile file,
                           OpenFile(path, O_RDWR | O_CREAT | O_EXCL));
  return std::unique_ptr<MeshWriter>(std::make_unique<FileMeshWriter>(
      shared_, std::move(file), std::move(path), std::move(announced)));
}

absl::StatusOr<std::unique_ptr<MeshReader>> DirectoryMeshStore::Open(
    const Sha256Digest& sha256) const {
  fs::path path = shared_->PathOf(sha256);
  if (::access(path.c_str(), F_OK) != 0 && errno == ENOENT) {
    return Damaged(sha256, "is missing");
  }
  ARGMESH_ASSIGN_OR_RETURN(PosixFile file, OpenFile(path, O_RDONLY));
  ARGMESH_ASSIGN_OR_RETURN(const int64_t size, FileSize(file, path));
  if (size == 0) return Damaged(sha256, "is empty");
  return std::unique_ptr<MeshReader>(std::make_unique<FileMeshReader>(
      std::move(file), std::move(path), sha256, size));
}

absl::Status DirectoryMeshStore::RemoveUnreferenced(
    const Sha256Digest& sha256, const IsReferenced& is_referenced) {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->holds == 0) return shared_->Remove(sha256, is_referenced);
  shared_->released[sha256] = is_referenced;
  return absl::OkStatus();
}

MeshPin DirectoryMeshStore::HoldRemovals() {
  const std::lock_guard lock(shared_->mutex);
  ++shared_->holds;
  return MeshPin(static_cast<const void*>(this),
                 [shared = shared_](const void*) { shared->EndHold(); });
}

absl::StatusOr<int64_t> DirectoryMeshStore::Sweep(
    absl::Time older_than, const IsReferenced& is_referenced) {
  const auto limit = fs::file_time_type::clock::now() -
                     absl::ToChronoSeconds(absl::Now() - older_than);
  const fs::path root = shared_->directory->blobs_path();
  std::vector<Sha256Digest> old;
  std::error_code error;
  for (fs::recursive_directory_iterator it(root, error), end;
       !error && it != end; it.increment(error)) {
    Sha256Digest sha256;
    std::error_code ignored;  // a file may go while it is looked at
    if (DigestOfName(it->path().filename().string(), sha256) &&
        it->last_write_time(ignored) < limit && !ignored) {
      old.push_back(sha256);
    }
  }
  if (error) return FileError("list", root, error.value());
  int64_t removed = 0;
  for (const Sha256Digest& sha256 : old) {
    ARGMESH_ASSIGN_OR_RETURN(const bool referenced, is_referenced(sha256));
    if (referenced) continue;
    ARGMESH_RETURN_IF_ERROR(RemoveUnreferenced(sha256, is_referenced));
    ++removed;
  }
  return removed;
}

}  // namespace argmesh
