#include "client/cli/query_mesh.h"

#include <string>

#include "absl/strings/str_format.h"
#include "client/cli/mesh_files.h"
#include "client/error_status.h"
#include "client/mesh_chunks.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_write.h"

namespace argmesh {

absl::StatusOr<v1::MeshContent> ReadQueryMesh(
    const std::filesystem::path& path) {
  v1::MeshContent content;
  content.set_format(FormatOfPath(path));
  ARGMESH_ASSIGN_OR_RETURN(*content.mutable_data(),
                           ReadFile(path, MeshLimits().max_bytes));
  return content;
}

absl::StatusOr<v1::MeshContent> ReadInlineMesh(
    const std::filesystem::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(v1::MeshContent content, ReadQueryMesh(path));
  const auto fits = [&content] {
    return static_cast<int64_t>(content.data().size()) <= kMaxInlineMeshBytes;
  };
  if (fits()) return content;
  ARGMESH_ASSIGN_OR_RETURN(
      const ParsedMesh parsed,
      ParseMesh(content.data(), MeshFormatFromPath(path.string())));
  ARGMESH_ASSIGN_OR_RETURN(*content.mutable_data(),
                           SerializeMesh(parsed.mesh, MeshFormat::kPly));
  content.set_format(v1::MESH_FORMAT_PLY);
  if (fits()) return content;
  return MakeStatus(
      absl::StatusCode::kResourceExhausted, "MESH_TOO_LARGE",
      absl::StrFormat("%s: %d bytes as binary PLY, a comparison takes %d; "
                      "ingest it into a collection with the same settings and "
                      "name the shape instead",
                      path.string(), content.data().size(),
                      kMaxInlineMeshBytes));
}

}  // namespace argmesh
