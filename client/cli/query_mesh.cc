#include "client/cli/query_mesh.h"

#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "client/cli/mesh_files.h"
#include "client/error_status.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_write.h"

namespace argmesh {

absl::StatusOr<v1::MeshContent> ReadQueryMesh(
    const std::filesystem::path& path) {
  const MeshLimits limits;
  ARGMESH_ASSIGN_OR_RETURN(std::string bytes, ReadFile(path, limits.max_bytes));
  v1::MeshContent content;
  content.set_format(FormatOfPath(path));
  if (static_cast<int64_t>(bytes.size()) > kMaxInlineMeshBytes) {
    ARGMESH_ASSIGN_OR_RETURN(
        const ParsedMesh parsed,
        ParseMesh(bytes, MeshFormatFromPath(path.string()), limits));
    ARGMESH_ASSIGN_OR_RETURN(bytes,
                             SerializeMesh(parsed.mesh, MeshFormat::kPly));
    content.set_format(v1::MESH_FORMAT_PLY);
  }
  if (static_cast<int64_t>(bytes.size()) > kMaxInlineMeshBytes) {
    return MakeStatus(
        absl::StatusCode::kResourceExhausted, "MESH_TOO_LARGE",
        absl::StrFormat("%s: %d bytes as binary PLY, a query holds %d; ingest "
                        "it into a collection with the same settings and "
                        "search by --shape instead",
                        path.string(), bytes.size(), kMaxInlineMeshBytes));
  }
  content.set_data(std::move(bytes));
  return content;
}

}  // namespace argmesh
