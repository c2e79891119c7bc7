// The file operations that durability rests on, with errors that name the
// path.
//
// Fails    kResourceExhausted STORE_FULL         no space, no quota
//          kUnavailable       STORE_UNAVAILABLE  anything else
#ifndef ARGMESH_SERVER_STORAGE_POSIX_FILE_H_
#define ARGMESH_SERVER_STORAGE_POSIX_FILE_H_

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace argmesh {

// Of what is read through, and not kept, at a time.
inline constexpr int64_t kPieceBytes = 1 << 20;

// An open file descriptor; -1: none.
class PosixFile {
 public:
  PosixFile() = default;
  explicit PosixFile(int descriptor) : descriptor_(descriptor) {}
  ~PosixFile();
  PosixFile(PosixFile&& other) noexcept;
  PosixFile& operator=(PosixFile&& other) noexcept;

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

// Of `errno` after a failed call; `what` such as "write".
absl::Status FileError(std::string_view what, const std::filesystem::path& path,
                       int error_number);

// Flags as open(2); files are private to the user and closed on exec.
absl::StatusOr<PosixFile> OpenFile(const std::filesystem::path& path,
                                   int flags);
absl::Status WriteAll(const PosixFile& file, const std::filesystem::path& path,
                      std::string_view bytes);
// At most `count` bytes at `offset`; fewer only at the end of the file.
absl::StatusOr<std::string> ReadAt(const PosixFile& file,
                                   const std::filesystem::path& path,
                                   int64_t offset, int64_t count);
absl::StatusOr<int64_t> FileSize(const PosixFile& file,
                                 const std::filesystem::path& path);
absl::Status SyncFile(const PosixFile& file, const std::filesystem::path& path);
// The file has these bytes, and they are durable; its name may not be yet.
absl::Status WriteFile(const std::filesystem::path& path,
                       std::string_view bytes);
// The file has these bytes, durably; until then it is as it was. They are
// written beside it, to its name and kUnfinishedSuffix.
inline constexpr char kUnfinishedSuffix[] = ".part";
absl::Status ReplaceFile(const std::filesystem::path& path,
                         std::string_view bytes);
// Makes names that were created, renamed or removed in it durable.
absl::Status SyncDirectory(const std::filesystem::path& path);
// Makes `path` durable when it is new; the folder above must exist.
absl::Status MakeDirectory(const std::filesystem::path& path);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_POSIX_FILE_H_
