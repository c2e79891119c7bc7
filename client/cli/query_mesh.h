// A mesh file as the query of a search: it has to fit in one message.
#ifndef ARGMESH_CLIENT_CLI_QUERY_MESH_H_
#define ARGMESH_CLIENT_CLI_QUERY_MESH_H_

#include <cstdint>
#include <filesystem>

#include "absl/status/statusor.h"
#include "argmesh/v1/mesh.pb.h"

namespace argmesh {

// Of a mesh in a message: the largest message less room for the rest.
inline constexpr int64_t kMaxInlineMeshBytes = (4 << 20) - (64 << 10);

// The file's bytes as they are; a file too large for a message is written
// again as binary PLY, which keeps every coordinate and triangle, and sent if
// that fits.
//
// Fails    kNotFound, kPermissionDenied  the file
//          kInvalidArgument              a large file that is malformed
//          kResourceExhausted            too large even so
absl::StatusOr<v1::MeshContent> ReadQueryMesh(
    const std::filesystem::path& path);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_QUERY_MESH_H_
