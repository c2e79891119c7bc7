#include "tests/reliability/file_calls.h"

#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <mutex>

namespace argmesh {
namespace {

using Kind = FileCall::Kind;

std::mutex mutex;  // held from before a call until after it
FileCallObserver* observer = nullptr;
std::string& Root() {
  static std::string root;
  return root;
}

bool IsBelowRoot(const std::string& path) {
  return path.starts_with(Root()) &&
         (path.size() == Root().size() || path[Root().size()] == '/');
}

std::string PathOf(int descriptor) {
  std::array<char, PATH_MAX> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t size = readlink(link.c_str(), path.data(), path.size());
  return size > 0 ? std::string(path.data(), static_cast<size_t>(size)) : "";
}

bool Exists(const char* path) {
  return syscall(SYS_faccessat, AT_FDCWD, path, F_OK) == 0;
}

// Makes the call; `make` returns what the C library's function would.
template <typename Make>
auto Observe(FileCall call, const Make& make) -> decltype(make()) {
  if (observer == nullptr || !IsBelowRoot(call.path)) return make();
  const int error = observer->Before(call);
  if (error != 0) {
    errno = error;
    return -1;
  }
  const auto result = make();
  if (result < 0) return result;
  if (call.kind == Kind::kWrite) {
    call.bytes = call.bytes.substr(0, static_cast<size_t>(result));
  }
  observer->After(call);
  return result;
}

int Open(const char* path, int flags, mode_t mode) {
  const std::lock_guard lock(mutex);
  const auto make = [=] {
    return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  };
  const bool exists = Exists(path);
  if ((flags & O_CREAT) != 0 && !exists) {
    return Observe({Kind::kCreate, path, "", 0, {}}, make);
  }
  if ((flags & O_TRUNC) != 0 && exists) {
    return Observe({Kind::kTruncate, path, "", 0, {}}, make);
  }
  return make();
}

int Sync(int descriptor, int64_t number) {
  const std::lock_guard lock(mutex);
  return Observe({Kind::kSync, PathOf(descriptor), "", 0, {}},
                 [=] { return static_cast<int>(syscall(number, descriptor)); });
}

ssize_t WriteAt(int descriptor, const void* bytes, size_t count, off_t offset) {
  const std::lock_guard lock(mutex);
  return Observe({Kind::kWrite,
                  PathOf(descriptor),
                  "",
                  offset,
                  {static_cast<const char*>(bytes), count}},
                 [=] {
                   return static_cast<ssize_t>(
                       syscall(SYS_pwrite64, descriptor, bytes, count, offset));
                 });
}

int Truncate(int descriptor, off_t size) {
  const std::lock_guard lock(mutex);
  return Observe({Kind::kTruncate, PathOf(descriptor), "", size, {}}, [=] {
    return static_cast<int>(syscall(SYS_ftruncate, descriptor, size));
  });
}

}  // namespace

const char* FileCallName(FileCall::Kind kind) {
  switch (kind) {
    case Kind::kCreate:
      return "create";
    case Kind::kWrite:
      return "write";
    case Kind::kTruncate:
      return "truncate";
    case Kind::kSync:
      return "sync";
    case Kind::kRename:
      return "rename";
    case Kind::kRemove:
      return "remove";
    case Kind::kMakeFolder:
      return "mkdir";
  }
  return "";
}

FileCallObservation::FileCallObservation(const std::filesystem::path& root,
                                         FileCallObserver* the_observer) {
  const std::lock_guard lock(mutex);
  Root() = root.string();
  observer = the_observer;
}

FileCallObservation::~FileCallObservation() {
  const std::lock_guard lock(mutex);
  observer = nullptr;
}

}  // namespace argmesh

// In place of the C library's, with its names and signatures.
extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return argmesh::Open(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return argmesh::Open(path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  const std::lock_guard lock(argmesh::mutex);
  const auto make = [=] {
    return static_cast<ssize_t>(syscall(SYS_write, descriptor, bytes, count));
  };
  if (argmesh::observer == nullptr) return make();
  const int64_t offset = syscall(SYS_lseek, descriptor, 0, SEEK_CUR);
  return argmesh::Observe({argmesh::FileCall::Kind::kWrite,
                           argmesh::PathOf(descriptor),
                           "",
                           offset,
                           {static_cast<const char*>(bytes), count}},
                          make);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t count, off_t offset) {
  return argmesh::WriteAt(descriptor, bytes, count, offset);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t count,
                 off64_t offset) {
  return argmesh::WriteAt(descriptor, bytes, count, offset);
}

int ftruncate(int descriptor, off_t size) noexcept {
  return argmesh::Truncate(descriptor, size);
}

int ftruncate64(int descriptor, off64_t size) noexcept {
  return argmesh::Truncate(descriptor, size);
}

int fsync(int descriptor) { return argmesh::Sync(descriptor, SYS_fsync); }

int fdatasync(int descriptor) {
  return argmesh::Sync(descriptor, SYS_fdatasync);
}

int rename(const char* from, const char* to) noexcept {
  const std::lock_guard lock(argmesh::mutex);
  return argmesh::Observe(
      {argmesh::FileCall::Kind::kRename, from, to, 0, {}},
      [=] { return static_cast<int>(syscall(SYS_rename, from, to)); });
}

int unlink(const char* path) noexcept {
  const std::lock_guard lock(argmesh::mutex);
  return argmesh::Observe(
      {argmesh::FileCall::Kind::kRemove, path, "", 0, {}},
      [=] { return static_cast<int>(syscall(SYS_unlink, path)); });
}

int remove(const char* path) noexcept {
  struct stat status {};
  if (lstat(path, &status) == 0 && S_ISDIR(status.st_mode)) return rmdir(path);
  return unlink(path);
}

int mkdir(const char* path, mode_t mode) noexcept {
  const std::lock_guard lock(argmesh::mutex);
  return argmesh::Observe(
      {argmesh::FileCall::Kind::kMakeFolder, path, "", 0, {}},
      [=] { return static_cast<int>(syscall(SYS_mkdir, path, mode)); });
}
}
