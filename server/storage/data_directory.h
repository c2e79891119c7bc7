// The folder that holds everything a server stores. One process at a time.
//
//   lock        held by flock(2); contains the process id
//   clean       there while the last stop was a clean one
//   catalog.db  SQLite (docs/formats.md), with -wal and -shm beside it
//   blobs/      meshes: ab/<sha256>
//   incoming/   meshes that are being written; emptied at every start
//   operations/ what is remembered of operations (operation_directory.h)
//   snapshots/  ID.tar and ID.tar.sha256 (snapshot_directory.h)
//   restoring/  a restore under way (restore.h)
#ifndef ARGMESH_SERVER_STORAGE_DATA_DIRECTORY_H_
#define ARGMESH_SERVER_STORAGE_DATA_DIRECTORY_H_

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/storage/posix_file.h"

namespace argmesh {

struct DataDirectoryOptions {
  // Writes that add are refused below so much free space; >= 0.
  int64_t min_free_bytes = 128LL << 20;
  // SQLite's write-ahead log does not work on network file systems.
  bool allow_network_file_system = false;
};

class DataDirectory;

// Space for what a write is going to add: while one lives, every check counts
// it as taken. Must not outlive its directory.
class SpaceClaim {
 public:
  SpaceClaim() = default;  // of nothing
  ~SpaceClaim() { Wrote(bytes_); }
  SpaceClaim(SpaceClaim&& other) noexcept;
  SpaceClaim& operator=(SpaceClaim&& other) noexcept;

  int64_t bytes() const { return bytes_; }
  // So many of its bytes are on the disk and need no claim any more.
  void Wrote(int64_t bytes);

 private:
  friend class DataDirectory;
  SpaceClaim(const DataDirectory& directory, int64_t bytes);

  const DataDirectory* directory_ = nullptr;
  int64_t bytes_ = 0;
};

class DataDirectory {
 public:
  // Creates it when missing, with its parents.
  //
  // Fails    kFailedPrecondition  in use by another process (named), or on a
  //                               network file system
  //          as posix_file.h
  static absl::StatusOr<std::shared_ptr<DataDirectory>> Open(
      const std::filesystem::path& path,
      const DataDirectoryOptions& options = {});

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path database_path() const { return path_ / "catalog.db"; }
  std::filesystem::path blobs_path() const { return path_ / "blobs"; }
  std::filesystem::path incoming_path() const { return path_ / "incoming"; }
  std::filesystem::path operations_path() const { return path_ / "operations"; }
  std::filesystem::path snapshots_path() const { return path_ / "snapshots"; }

  absl::StatusOr<int64_t> FreeBytes() const;
  // kResourceExhausted STORE_FULL when `extra_bytes` more, beside all that is
  // claimed, would eat into the space kept free.
  absl::Status CheckFreeSpace(int64_t extra_bytes) const;
  // As CheckFreeSpace, and keeps them from others. `reusable_bytes` of the
  // database's file are free: up to half of the space kept free may be eaten
  // into instead; its write-ahead log needs the other half.
  absl::StatusOr<SpaceClaim> Claim(int64_t bytes,
                                   int64_t reusable_bytes = 0) const;

  // Whether the last stop was clean.
  bool IsMarkedClean() const;
  absl::Status MarkClean() const;
  absl::Status ClearCleanMark() const;

 private:
  DataDirectory(std::filesystem::path path, const DataDirectoryOptions& options,
                PosixFile lock);

  std::filesystem::path path_;
  DataDirectoryOptions options_;
  PosixFile lock_;  // the lock goes with it
  mutable std::atomic<int64_t> claimed_{0};

  friend class SpaceClaim;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_DATA_DIRECTORY_H_
