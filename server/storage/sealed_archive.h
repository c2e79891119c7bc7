// The file format of a snapshot: a POSIX tar archive whose last member, `seal`,
// is the SHA-256 of everything before it.
//
// Any tar program lists and unpacks it; this reader takes nothing but what the
// writer makes, and notices every changed, missing or additional byte. Member
// names are the caller's business.
#ifndef ARGMESH_SERVER_STORAGE_SEALED_ARCHIVE_H_
#define ARGMESH_SERVER_STORAGE_SEALED_ARCHIVE_H_

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/sha256.h"
#include "server/storage/posix_file.h"

namespace argmesh {

inline constexpr size_t kMaxMemberName = 99;

struct ArchiveSummary {
  int64_t size_bytes = 0;
  Sha256Digest sha256{};  // of the whole file
};

// Writes members one after the other. Errors as posix_file.h.
class ArchiveWriter {
 public:
  // The file must not exist.
  static absl::StatusOr<std::unique_ptr<ArchiveWriter>> Create(
      const std::filesystem::path& path);

  // Begins a member of `size` bytes; the one before must be complete. At most
  // kMaxMemberName characters.
  absl::Status Begin(std::string_view name, int64_t size);
  absl::Status Append(std::string_view bytes);
  // Seals, syncs and closes the file.
  absl::StatusOr<ArchiveSummary> Finish();

 private:
  ArchiveWriter(PosixFile file, std::filesystem::path path)
      : file_(std::move(file)), path_(std::move(path)) {}
  absl::Status Put(std::string_view bytes);
  absl::Status PadMember();

  PosixFile file_;
  const std::filesystem::path path_;
  int64_t size_bytes_ = 0;
  int64_t member_left_ = 0;
  int64_t member_size_ = 0;
  Sha256Hasher content_;  // for the seal
  Sha256Hasher whole_;
};

struct ArchiveMember {
  std::string name;
  int64_t size_bytes = 0;
};

// kDataLoss STORED_DATA_DAMAGED for whatever the writer would not have made.
class ArchiveReader {
 public:
  static absl::StatusOr<std::unique_ptr<ArchiveReader>> Open(
      const std::filesystem::path& path);

  // The next member; false at the end, once the seal has been checked: only
  // then may anything of the archive be used. The member before must have been
  // read to its end.
  absl::StatusOr<bool> Next(ArchiveMember& member);
  // The next at most `max_bytes` of the member; empty at its end.
  absl::StatusOr<std::string> Read(int64_t max_bytes);

 private:
  ArchiveReader(PosixFile file, std::filesystem::path path, int64_t size_bytes)
      : file_(std::move(file)), path_(std::move(path)), size_(size_bytes) {}
  absl::StatusOr<std::string> Take(int64_t count);
  absl::Status CheckSeal(const ArchiveMember& seal, Sha256Digest expected);
  absl::Status Damaged(std::string_view what) const;

  PosixFile file_;
  const std::filesystem::path path_;
  const int64_t size_;
  int64_t position_ = 0;
  int64_t member_left_ = 0;
  int64_t padding_ = 0;
  std::unique_ptr<Sha256Hasher> content_ = std::make_unique<Sha256Hasher>();
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_SEALED_ARCHIVE_H_
