// A mesh file as the query of a search, or as a side of a comparison.
#ifndef ARGMESH_CLIENT_CLI_QUERY_MESH_H_
#define ARGMESH_CLIENT_CLI_QUERY_MESH_H_

#include <filesystem>

#include "absl/status/statusor.h"
#include "argmesh/v1/mesh.pb.h"

namespace argmesh {

// The file's bytes as they are, of any size that the server may take.
//
// Fails    kNotFound, kPermissionDenied  the file
//          kResourceExhausted            larger than any mesh may be
absl::StatusOr<v1::MeshContent> ReadQueryMesh(
    const std::filesystem::path& path);

// The same to fit in one message; a file too large for that is written
// again as binary PLY, which keeps every coordinate and triangle, and sent if
// that fits.
//
// Fails    kNotFound, kPermissionDenied  the file
//          kInvalidArgument              a large file that is malformed
//          kResourceExhausted            too large even so
absl::StatusOr<v1::MeshContent> ReadInlineMesh(
    const std::filesystem::path& path);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_QUERY_MESH_H_
