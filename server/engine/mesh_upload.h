// A mesh that arrives in pieces, before it belongs to a shape or a query.
//
// Nothing of it is visible or kept until Engine::AddShape takes it; destroying
// it discards it. One upload belongs to one thread at a time; calls block on
// the disk.
#ifndef ARGMESH_SERVER_ENGINE_MESH_UPLOAD_H_
#define ARGMESH_SERVER_ENGINE_MESH_UPLOAD_H_

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/sha256.h"
#include "server/engine/mesh_store.h"

namespace argmesh {

// A complete mesh: its bytes, or what an upload finished as.
using MeshSource = std::variant<std::string, std::unique_ptr<StagedMesh>>;

struct UploadAnnouncement {
  int64_t size_bytes = 0;              // > 0
  std::optional<Sha256Digest> sha256;  // checked by Finish when given
};

// MESH_DIGEST_MISMATCH unless equal.
absl::Status CheckDigest(const Sha256Digest& announced,
                         const Sha256Digest& received);

class MeshUpload {
 public:
  MeshUpload(UploadAnnouncement announced, std::unique_ptr<MeshWriter> writer);

  // kInvalidArgument MESH_SIZE_MISMATCH beyond the announced size; STORE_FULL.
  absl::Status Append(std::string_view chunk);

  int64_t received_bytes() const { return received_bytes_; }

  // Once, after the last chunk. MESH_SIZE_MISMATCH, MESH_DIGEST_MISMATCH.
  absl::StatusOr<std::unique_ptr<StagedMesh>> Finish();

 private:
  UploadAnnouncement announced_;
  std::unique_ptr<MeshWriter> writer_;
  int64_t received_bytes_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_MESH_UPLOAD_H_
