// A snapshot in place of what a data directory holds, while no server uses it.
//
// Everything of the snapshot is unpacked beside the data and checked first:
// the seal, the digest of every mesh, the database, and that every mesh it
// names is there. Only then the data changes places, and what was there before
// is kept below before-restore-<time>/. A restore that was interrupted leaves
// either the data before, or is finished by the next start (FinishRestore).
#ifndef ARGMESH_SERVER_STORAGE_RESTORE_H_
#define ARGMESH_SERVER_STORAGE_RESTORE_H_

#include <cstdint>
#include <filesystem>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/storage/data_directory.h"

namespace argmesh {

struct RestoreReport {
  int64_t meshes = 0;
  int64_t bytes = 0;           // of the snapshot
  std::filesystem::path kept;  // what was there before; empty: nothing was
};

// Fails    kDataLoss STORED_DATA_DAMAGED  the snapshot is not whole; nothing
//                                         was changed
//          kFailedPrecondition            it is of a newer version, or the
//                                         directory is in use
//          as posix_file.h
absl::StatusOr<RestoreReport> RestoreSnapshot(
    const std::filesystem::path& snapshot, const DataDirectory& directory);

// Ends the restore that a crash interrupted after its checks, removes one that
// was interrupted before. Called by DataDirectory::Open.
absl::Status FinishRestore(const std::filesystem::path& data);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_RESTORE_H_
