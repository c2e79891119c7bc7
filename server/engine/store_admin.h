// Port: copies of everything stored, and checks of it, while it is in use.
//
// A snapshot is one sealed file that holds the catalog as of one moment and
// every mesh that it names (docs/formats.md). Whatever was committed before
// CreateSnapshot was called is in it.
//
// Fails    by MakeError with the reasons named at each function, and anywhere
//          kStoreUnavailable, kCancelled and kDeadlineExceeded.
// Thread-safe. Calls block for as long as reading everything takes.
#ifndef ARGMESH_SERVER_ENGINE_STORE_ADMIN_H_
#define ARGMESH_SERVER_ENGINE_STORE_ADMIN_H_

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/sha256.h"
#include "core/base/stop_token.h"

namespace argmesh {

struct SnapshotRecord {
  std::string id;
  absl::Time create_time;
  int64_t size_bytes = 0;
  Sha256Digest sha256{};  // of the file
};

struct StorageReport {
  int64_t shapes = 0;
  int64_t checksums = 0;  // of stored bytes in the catalog, that were compared
  int64_t meshes = 0;
  int64_t mesh_bytes = 0;  // that were read
  int64_t findings = 0;
  std::vector<std::string> first_findings;  // at most kMaxFindings
};
inline constexpr size_t kMaxFindings = 100;

class SnapshotReader {
 public:
  virtual ~SnapshotReader() = default;
  virtual const SnapshotRecord& record() const = 0;
  // The next at most `max_bytes` bytes; empty at the end.
  virtual absl::StatusOr<std::string> Read(int64_t max_bytes) = 0;
};

class StoreAdmin {
 public:
  virtual ~StoreAdmin() = default;

  // kSnapshotExists; kStoreFull; kStoredDataDamaged: nothing damaged is ever
  // put into a snapshot. What fails leaves nothing behind.
  virtual absl::StatusOr<SnapshotRecord> CreateSnapshot(
      std::string_view id, const StopToken& stop) = 0;
  // kSnapshotNotFound, here and below.
  virtual absl::StatusOr<SnapshotRecord> GetSnapshot(
      std::string_view id) const = 0;
  virtual absl::StatusOr<std::vector<SnapshotRecord>> ListSnapshots()
      const = 0;  // by id
  virtual absl::StatusOr<std::unique_ptr<SnapshotReader>> OpenSnapshot(
      std::string_view id) const = 0;
  virtual absl::Status DeleteSnapshot(std::string_view id) = 0;

  // Reads everything, or what belongs to the shapes of one collection
  // (kCollectionNotFound). What is damaged is a finding, not a failure.
  virtual absl::StatusOr<StorageReport> Verify(std::string_view collection,
                                               const StopToken& stop) const = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_STORE_ADMIN_H_
