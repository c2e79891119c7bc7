#include "server/engine/mesh_upload.h"

#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

absl::Status SizeMismatch(int64_t announced, int64_t received) {
  return MakeError(
      ErrorReason::kMeshSizeMismatch,
      absl::StrFormat("%d bytes were announced, %s%d came", announced,
                      received > announced ? "at least " : "", received),
      {{"announced", absl::StrFormat("%d", announced)},
       {"received", absl::StrFormat("%d", received)}});
}

}  // namespace

absl::Status CheckDigest(const Sha256Digest& announced,
                         const Sha256Digest& received) {
  if (announced == received) return absl::OkStatus();
  return MakeError(
      ErrorReason::kMeshDigestMismatch,
      absl::StrFormat("SHA-256 %s was announced, %s came", ToHex(announced),
                      ToHex(received)),
      {{"announced", ToHex(announced)}, {"received", ToHex(received)}});
}

MeshUpload::MeshUpload(UploadAnnouncement announced,
                       std::unique_ptr<MeshWriter> writer)
    : announced_(announced), writer_(std::move(writer)) {}

absl::Status MeshUpload::Append(std::string_view chunk) {
  const int64_t received = received_bytes_ + static_cast<int64_t>(chunk.size());
  if (received > announced_.size_bytes) {
    return SizeMismatch(announced_.size_bytes, received);
  }
  ARGMESH_RETURN_IF_ERROR(writer_->Append(chunk));
  received_bytes_ = received;
  return absl::OkStatus();
}

absl::StatusOr<std::unique_ptr<StagedMesh>> MeshUpload::Finish() {
  if (received_bytes_ != announced_.size_bytes) {
    return SizeMismatch(announced_.size_bytes, received_bytes_);
  }
  ARGMESH_ASSIGN_OR_RETURN(std::unique_ptr<StagedMesh> mesh, writer_->Seal());
  if (announced_.sha256) {
    ARGMESH_RETURN_IF_ERROR(CheckDigest(*announced_.sha256, mesh->sha256()));
  }
  return mesh;
}

}  // namespace argmesh
