#include "server/storage/posix_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

constexpr mode_t kPrivateFile = 0600;
constexpr mode_t kPrivateDirectory = 0700;

}  // namespace

PosixFile::~PosixFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

PosixFile::PosixFile(PosixFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

PosixFile& PosixFile::operator=(PosixFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

absl::Status FileError(std::string_view what, const std::filesystem::path& path,
                       int error_number) {
  const bool full = error_number == ENOSPC || error_number == EDQUOT;
  return MakeError(
      full ? ErrorReason::kStoreFull : ErrorReason::kStoreUnavailable,
      absl::StrFormat("%s %s: %s", std::string(what), path.string(),
                      std::generic_category().message(error_number)));
}

absl::StatusOr<PosixFile> OpenFile(const std::filesystem::path& path,
                                   int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, kPrivateFile);
  if (descriptor < 0) return FileError("open", path, errno);
  return PosixFile(descriptor);
}

absl::Status WriteAll(const PosixFile& file, const std::filesystem::path& path,
                      std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written =
        ::write(file.descriptor(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return FileError("write", path, errno);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return absl::OkStatus();
}

absl::StatusOr<std::string> ReadAt(const PosixFile& file,
                                   const std::filesystem::path& path,
                                   int64_t offset, int64_t count) {
  std::string bytes(static_cast<size_t>(count), '\0');
  size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got =
        ::pread(file.descriptor(), bytes.data() + filled, bytes.size() - filled,
                static_cast<off_t>(offset) + static_cast<off_t>(filled));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return FileError("read", path, errno);
    if (got == 0) break;
    filled += static_cast<size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

absl::StatusOr<int64_t> FileSize(const PosixFile& file,
                                 const std::filesystem::path& path) {
  struct stat status {};
  if (::fstat(file.descriptor(), &status) != 0) {
    return FileError("stat", path, errno);
  }
  return static_cast<int64_t>(status.st_size);
}

absl::Status SyncFile(const PosixFile& file,
                      const std::filesystem::path& path) {
  if (::fsync(file.descriptor()) == 0) return absl::OkStatus();
  return FileError("fsync", path, errno);
}

absl::Status WriteFile(const std::filesystem::path& path,
                       std::string_view bytes) {
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile file,
                           OpenFile(path, O_WRONLY | O_CREAT | O_TRUNC));
  ARGMESH_RETURN_IF_ERROR(WriteAll(file, path, bytes));
  return SyncFile(file, path);
}

absl::Status ReplaceFile(const std::filesystem::path& path,
                         std::string_view bytes) {
  const std::filesystem::path unfinished = path.string() + kUnfinishedSuffix;
  absl::Status written = WriteFile(unfinished, bytes);
  if (written.ok() && std::rename(unfinished.c_str(), path.c_str()) != 0) {
    written = FileError("rename", path, errno);
  }
  if (!written.ok()) {
    ::unlink(unfinished.c_str());
    return written;
  }
  return SyncDirectory(path.parent_path());
}

absl::Status SyncDirectory(const std::filesystem::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile directory,
                           OpenFile(path, O_RDONLY | O_DIRECTORY));
  return SyncFile(directory, path);
}

absl::Status MakeDirectory(const std::filesystem::path& path) {
  if (::mkdir(path.c_str(), kPrivateDirectory) == 0) {
    const std::filesystem::path above = path.parent_path();
    return SyncDirectory(above.empty() ? "." : above);
  }
  if (errno == EEXIST) return absl::OkStatus();
  return FileError("mkdir", path, errno);
}

}  // namespace argmesh
