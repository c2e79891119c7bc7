// The mesh files that an ingest names: files as given, folders with all that
// is below them.
#ifndef ARGMESH_CLIENT_CLI_MESH_FILES_H_
#define ARGMESH_CLIENT_CLI_MESH_FILES_H_

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "argmesh/v1/mesh.pb.h"

namespace argmesh {

struct MeshFile {
  std::filesystem::path path;  // to open it
  std::string relative;        // to the folder given; the name of a file given
  std::string shape_id;        // of `relative`, unique in a list
  v1::MeshFormat format = v1::MESH_FORMAT_UNSPECIFIED;
};

// From the extension .off .obj .ply .stl in any case; UNSPECIFIED for others.
v1::MeshFormat FormatOfPath(const std::filesystem::path& path);

// Files sorted by path below each argument, arguments in their order. Hidden
// files and folders are left out, links to folders are not followed, a file
// met twice counts once. Where different files of several arguments have the
// same relative path, the names of folders above are put before it until they
// differ.
//
// Fails    kNotFound          no such file or folder
//          kInvalidArgument   a file given by name is no mesh file; no mesh
//                             file at all
//          kPermissionDenied  a folder cannot be read
absl::StatusOr<std::vector<MeshFile>> FindMeshFiles(
    const std::vector<std::string>& arguments);

// Fails    kNotFound, kPermissionDenied, kResourceExhausted over `max_bytes`.
absl::StatusOr<std::string> ReadFile(const std::filesystem::path& path,
                                     int64_t max_bytes);

// Replaces the file.
absl::Status WriteFile(const std::filesystem::path& path,
                       std::string_view bytes);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_MESH_FILES_H_
