// What is put aside of shapes until their collection gets other settings, as
// rows.
#ifndef ARGMESH_SERVER_STORAGE_STAGED_ROWS_H_
#define ARGMESH_SERVER_STORAGE_STAGED_ROWS_H_

#include <cstdint>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/sha256.h"
#include "server/engine/catalog_requests.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

// The bytes of a StagedDescription that are made before a write's turn comes.
struct StagedBytes {
  std::string labels;  // compressed
  std::string details;
};

// MESH_TOO_LARGE as CompressLabels.
absl::StatusOr<StagedBytes> MakeStagedBytes(
    const StagedDescription& description);

// None: the collection is at no stage.
absl::StatusOr<std::optional<SettingsStage>> ReadStage(
    SqliteConnection& connection, int64_t collection);

// In place of what was put aside for the shape before.
absl::Status WriteStaged(SqliteConnection& connection, int64_t shape,
                         const Sha256Digest& mesh,
                         const StagedDescription& description,
                         const StagedBytes& bytes);

// The stage, and what was put aside at it; its graphs stay, unused.
absl::Status ForgetStage(SqliteConnection& connection, int64_t collection);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_STAGED_ROWS_H_
