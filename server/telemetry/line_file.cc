#include "server/telemetry/line_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
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
    const std::string& path) {
  ARGMESH_ASSIGN_OR_RETURN(const int descriptor, OpenForAppending(path));
  return std::unique_ptr<LineFile>(new LineFile(path, descriptor));
}

LineFile::LineFile(std::string path, int descriptor)
    : path_(std::move(path)), descriptor_(descriptor) {}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::Write(std::string_view line) {
  const std::string text = absl::StrCat(std::string(line), "\n");
  const std::lock_guard lock(mutex_);
  ssize_t written = 0;
  do {
    written = ::write(descriptor_, text.data(), text.size());
  } while (written < 0 && errno == EINTR);
  if (written != static_cast<ssize_t>(text.size())) ++dropped_;
}

absl::Status LineFile::Reopen() {
  ARGMESH_ASSIGN_OR_RETURN(const int descriptor, OpenForAppending(path_));
  const std::lock_guard lock(mutex_);
  ::close(std::exchange(descriptor_, descriptor));
  return absl::OkStatus();
}

}  // namespace argmesh
