#include "server/storage/data_directory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/storage/restore.h"

namespace argmesh {
namespace {

constexpr int64_t kMaxPidBytes = 20;

// statfs(2) magic numbers of file systems that other machines may share.
bool IsNetworkFileSystem(int64_t magic) {
  constexpr int64_t kNfs = 0x6969;
  constexpr int64_t kSmb = 0x517B;
  constexpr int64_t kSmb2 = 0xFE534D42;
  constexpr int64_t kCifs = 0xFF534D42;
  constexpr int64_t kFuse = 0x65735546;
  return magic == kNfs || magic == kSmb || magic == kSmb2 || magic == kCifs ||
         magic == kFuse;
}

absl::Status CheckFileSystem(const std::filesystem::path& path) {
  struct statfs status {};
  if (::statfs(path.c_str(), &status) != 0) {
    return FileError("statfs", path, errno);
  }
  const auto magic = static_cast<int64_t>(status.f_type) & 0xFFFFFFFF;
  if (!IsNetworkFileSystem(magic)) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrFormat(
      "data directory %s is on a network file system (type %#x), where a "
      "database cannot be kept safe",
      path.string(), magic));
}

absl::StatusOr<PosixFile> Lock(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "lock";
  ARGMESH_ASSIGN_OR_RETURN(PosixFile file, OpenFile(path, O_RDWR | O_CREAT));
  if (::flock(file.descriptor(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) return FileError("lock", path, errno);
    std::string holder =
        ReadAt(file, path, 0, kMaxPidBytes).value_or(std::string());
    absl::StripAsciiWhitespace(&holder);
    return absl::FailedPreconditionError(absl::StrFormat(
        "data directory %s is in use by %s", directory.string(),
        holder.empty() ? "another process" : "process " + holder));
  }
  if (::ftruncate(file.descriptor(), 0) != 0) {
    return FileError("truncate", path, errno);
  }
  ARGMESH_RETURN_IF_ERROR(
      WriteAll(file, path, absl::StrFormat("%d\n", ::getpid())));
  return file;
}

}  // namespace

SpaceClaim::SpaceClaim(const DataDirectory& directory, int64_t bytes)
    : directory_(&directory), bytes_(bytes) {
  directory.claimed_ += bytes;
}

SpaceClaim::SpaceClaim(SpaceClaim&& other) noexcept
    : directory_(other.directory_), bytes_(std::exchange(other.bytes_, 0)) {}

SpaceClaim& SpaceClaim::operator=(SpaceClaim&& other) noexcept {
  std::swap(directory_, other.directory_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

void SpaceClaim::Wrote(int64_t bytes) {
  const int64_t done = std::min(bytes, bytes_);
  bytes_ -= done;
  if (directory_ != nullptr) directory_->claimed_ -= done;
}

DataDirectory::DataDirectory(std::filesystem::path path,
                             const DataDirectoryOptions& options,
                             PosixFile lock)
    : path_(std::move(path)), options_(options), lock_(std::move(lock)) {}

absl::StatusOr<std::shared_ptr<DataDirectory>> DataDirectory::Open(
    const std::filesystem::path& path, const DataDirectoryOptions& options) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  if (error) return FileError("resolve", path, error.value());
  std::filesystem::create_directories(absolute.parent_path(), error);
  if (error) return FileError("mkdir", absolute.parent_path(), error.value());
  ARGMESH_RETURN_IF_ERROR(MakeDirectory(absolute));
  if (!options.allow_network_file_system) {
    ARGMESH_RETURN_IF_ERROR(CheckFileSystem(absolute));
  }
  ARGMESH_ASSIGN_OR_RETURN(PosixFile lock, Lock(absolute));
  std::shared_ptr<DataDirectory> directory(
      new DataDirectory(absolute, options, std::move(lock)));
  ARGMESH_RETURN_IF_ERROR(FinishRestore(absolute));
  ARGMESH_RETURN_IF_ERROR(MakeDirectory(directory->blobs_path()));
  ARGMESH_RETURN_IF_ERROR(MakeDirectory(directory->incoming_path()));
  ARGMESH_RETURN_IF_ERROR(MakeDirectory(directory->snapshots_path()));
  return directory;
}

absl::StatusOr<int64_t> DataDirectory::FreeBytes() const {
  struct statvfs status {};
  if (::statvfs(path_.c_str(), &status) != 0) {
    return FileError("statvfs", path_, errno);
  }
  return static_cast<int64_t>(status.f_bavail) *
         static_cast<int64_t>(status.f_frsize);
}

absl::Status DataDirectory::CheckFreeSpace(int64_t extra_bytes) const {
  ARGMESH_ASSIGN_OR_RETURN(const int64_t free_bytes, FreeBytes());
  const int64_t needed = claimed_ + extra_bytes;
  if (free_bytes - needed >= options_.min_free_bytes) return absl::OkStatus();
  return MakeError(
      ErrorReason::kStoreFull,
      absl::StrFormat("%d bytes are free, %d are kept free, %d are needed for "
                      "this write and those under way",
                      free_bytes, options_.min_free_bytes, needed),
      {{"free_bytes", absl::StrFormat("%d", free_bytes)}});
}

absl::StatusOr<SpaceClaim> DataDirectory::Claim(int64_t bytes,
                                                int64_t reusable_bytes) const {
  // Claimed first: of two at a time, each sees the other.
  SpaceClaim claim(*this, bytes);
  ARGMESH_RETURN_IF_ERROR(
      CheckFreeSpace(-std::min(reusable_bytes, options_.min_free_bytes / 2)));
  return claim;
}

bool DataDirectory::IsMarkedClean() const {
  return ::access((path_ / "clean").c_str(), F_OK) == 0;
}

absl::Status DataDirectory::MarkClean() const {
  const std::filesystem::path mark = path_ / "clean";
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile file,
                           OpenFile(mark, O_WRONLY | O_CREAT));
  ARGMESH_RETURN_IF_ERROR(SyncFile(file, mark));
  return SyncDirectory(path_);
}

absl::Status DataDirectory::ClearCleanMark() const {
  const std::filesystem::path mark = path_ / "clean";
  if (::unlink(mark.c_str()) != 0 && errno != ENOENT) {
    return FileError("unlink", mark, errno);
  }
  return SyncDirectory(path_);
}

}  // namespace argmesh
