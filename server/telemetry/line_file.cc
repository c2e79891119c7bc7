#include "server/telemetry/line_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr mode_t kOwnerOnly = 0600;

absl::StatusOr<int> OpenForAppending(const std::string& path) {
  const int descriptor = ::open(
      path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kOwnerOnly);
  if (descriptor >= 0) return descriptor;
  return absl::UnavailableError(absl::StrCat(
      "cannot open ", path, ": ", std::system_category().message(errno)));
}

}  // namespace

absl::StatusOr<std::unique_ptr<LineFile>> LineFile::Open(
    const std::string& path, int64_t max_bytes) {
  ARGMESH_ASSIGN_OR_RETURN(const int descriptor, OpenForAppending(path));
  return std::unique_ptr<LineFile>(new LineFile(path, max_bytes, descriptor));
}

LineFile::LineFile(std::string path, int64_t max_bytes, int descriptor)
    : path_(std::move(path)), max_bytes_(max_bytes) {
  Use(descriptor);
}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::Use(int descriptor) {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = descriptor;
  struct stat status {};
  bounded_ = max_bytes_ > 0 && ::fstat(descriptor, &status) == 0 &&
             S_ISREG(status.st_mode);
  bytes_ = status.st_size;
}

bool LineFile::Rotate() {
  const std::string older = path_ + ".1";
  // Gone: somebody else has renamed it.
  if (std::rename(path_.c_str(), older.c_str()) != 0 && errno != ENOENT) {
    return false;
  }
  const absl::StatusOr<int> descriptor = OpenForAppending(path_);
  if (descriptor.ok()) Use(*descriptor);
  return descriptor.ok();
}

bool LineFile::MakeRoom(int64_t bytes) {
  if (!bounded_ || bytes_ == 0 || bytes_ + bytes <= max_bytes_) return true;
  return Rotate();
}

void LineFile::Write(std::string_view line) {
  const std::string text = absl::StrCat(std::string(line), "\n");
  const std::lock_guard lock(mutex_);
  if (!MakeRoom(static_cast<int64_t>(text.size()))) {
    ++dropped_;
    return;
  }
  ssize_t written = 0;
  do {
    written = ::write(descriptor_, text.data(), text.size());
  } while (written < 0 && errno == EINTR);
  if (written != static_cast<ssize_t>(text.size())) ++dropped_;
  if (written > 0) bytes_ += written;
}

absl::Status LineFile::Reopen() {
  ARGMESH_ASSIGN_OR_RETURN(const int descriptor, OpenForAppending(path_));
  const std::lock_guard lock(mutex_);
  Use(descriptor);
  return absl::OkStatus();
}

}  // namespace argmesh
