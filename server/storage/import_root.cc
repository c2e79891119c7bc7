#include "server/storage/import_root.h"

#include <dirent.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

absl::Status Unreadable(const std::string& path, std::string_view why) {
  return MakeError(ErrorReason::kFileUnreadable,
                   absl::StrCat("\"", path, "\": ", std::string(why)),
                   {{"path", path}});
}

absl::Status Unreadable(const std::string& path, int error_number) {
  if (error_number == EXDEV) {
    return Unreadable(path, "leads out of the import root");
  }
  if (error_number == ELOOP) return Unreadable(path, "leads over a link");
  return Unreadable(path, std::generic_category().message(error_number));
}

// Either may be empty: the folder that the path is relative to.
std::string Join(const std::string& folder, const std::string& name) {
  if (folder.empty() || name.empty()) return folder + name;
  return absl::StrCat(folder, "/", name);
}

struct Entries {
  std::vector<std::string> folders;
  std::vector<std::string> files;
};

// The type of an entry where the file system does not tell it with the name.
unsigned char TypeOf(int folder, const dirent& entry) {
  struct stat status {};
  if (entry.d_type != DT_UNKNOWN ||
      ::fstatat(folder, entry.d_name, &status, AT_SYMLINK_NOFOLLOW) != 0) {
    return entry.d_type;
  }
  return static_cast<unsigned char>(IFTODT(status.st_mode));
}

absl::StatusOr<Entries> ReadEntries(const PosixFile& folder,
                                    const std::string& path,
                                    const StopToken& stop) {
  // closedir closes the descriptor it was given.
  const int own = ::fcntl(folder.descriptor(), F_DUPFD_CLOEXEC, 0);
  DIR* stream = own < 0 ? nullptr : ::fdopendir(own);
  if (stream == nullptr) {
    const int error = errno;
    if (own >= 0) ::close(own);
    return Unreadable(path, error);
  }
  const std::unique_ptr<DIR, int (*)(DIR*)> close_later(stream, ::closedir);
  Entries entries;
  while (true) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    errno = 0;
    const dirent* entry = ::readdir(stream);
    if (entry == nullptr) break;
    const std::string name = entry->d_name;
    if (name.starts_with('.')) continue;
    const unsigned char type = TypeOf(own, *entry);
    if (type == DT_DIR) {
      entries.folders.push_back(name);
    } else if (type == DT_REG || type == DT_LNK) {
      entries.files.push_back(name);
    }
  }
  if (errno != 0) return Unreadable(path, errno);
  return entries;
}

}  // namespace

absl::StatusOr<std::unique_ptr<ImportRoot>> ImportRoot::Open(
    const std::filesystem::path& root) {
  ARGMESH_ASSIGN_OR_RETURN(PosixFile folder,
                           OpenFile(root, O_RDONLY | O_DIRECTORY));
  return std::unique_ptr<ImportRoot>(new ImportRoot(std::move(folder)));
}

absl::StatusOr<PosixFile> ImportRoot::OpenBelow(const std::string& path,
                                                int flags) const {
  if (path.find('\0') != std::string::npos) return Unreadable(path, ENOENT);
  open_how how{};
  how.flags = static_cast<unsigned>(flags | O_CLOEXEC);
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS;
  const int64_t descriptor =
      ::syscall(SYS_openat2, root_.descriptor(),
                path.empty() ? "." : path.c_str(), &how, sizeof(how));
  if (descriptor < 0) return Unreadable(path, errno);
  return PosixFile(static_cast<int>(descriptor));
}

absl::StatusOr<std::vector<std::string>> ImportRoot::ListFiles(
    const std::string& folder, const StopToken& stop) const {
  std::vector<std::string> files;
  std::vector<std::string> left = {""};  // relative to `folder`
  while (!left.empty()) {
    const std::string relative = std::move(left.back());
    left.pop_back();
    const std::string path = Join(folder, relative);
    ARGMESH_ASSIGN_OR_RETURN(const PosixFile opened,
                             OpenBelow(path, O_RDONLY | O_DIRECTORY));
    ARGMESH_ASSIGN_OR_RETURN(const Entries entries,
                             ReadEntries(opened, path, stop));
    for (const std::string& name : entries.folders) {
      left.push_back(Join(relative, name));
    }
    for (const std::string& name : entries.files) {
      files.push_back(Join(relative, name));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

absl::StatusOr<std::string> ImportRoot::Read(const std::string& folder,
                                             const std::string& file,
                                             int64_t max_bytes) const {
  const std::string path = Join(folder, file);
  // Not to wait for the other end of a pipe.
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile opened,
                           OpenBelow(path, O_RDONLY | O_NONBLOCK));
  struct stat status {};
  if (::fstat(opened.descriptor(), &status) != 0) {
    return Unreadable(path, errno);
  }
  if (!S_ISREG(status.st_mode)) return Unreadable(path, "is no file");
  if (status.st_size > max_bytes) {
    return MakeError(ErrorReason::kMeshTooLarge,
                     absl::StrFormat("%s: %d bytes, the limit is %d", path,
                                     status.st_size, max_bytes),
                     {{"limit", absl::StrCat(max_bytes)},
                      {"size", absl::StrCat(status.st_size)}});
  }
  absl::StatusOr<std::string> bytes =
      ReadAt(opened, path, 0, static_cast<int64_t>(status.st_size));
  if (!bytes.ok())
    return Unreadable(path, std::string(bytes.status().message()));
  return bytes;
}

}  // namespace argmesh
