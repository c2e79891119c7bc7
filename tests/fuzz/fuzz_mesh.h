// What must hold for any bytes given to a mesh parser: an error that names a
// reason, or a proper mesh that is the same after writing and reading it.
#ifndef ARGMESH_TESTS_FUZZ_FUZZ_MESH_H_
#define ARGMESH_TESTS_FUZZ_FUZZ_MESH_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_write.h"
#include "core/mesh/triangle_mesh.h"
#include "tests/fuzz/require.h"

namespace argmesh {

inline void CheckError(const absl::Status& status) {
  Require(status.code() == absl::StatusCode::kInvalidArgument ||
              status.code() == absl::StatusCode::kResourceExhausted,
          "an error is kInvalidArgument or kResourceExhausted");
  Require(!status.message().empty(), "an error has a message");
}

inline void CheckParsed(const ParsedMesh& parsed) {
  Require(CheckMesh(parsed.mesh).ok(), "indices and coordinates are valid");
  Require(parsed.mesh.num_faces() > 0, "a mesh has faces");
  Require(
      parsed.file_face.size() == static_cast<size_t>(parsed.mesh.num_faces()),
      "every triangle has its face of the file");
  for (const int32_t face : parsed.file_face) {
    Require(face >= 0 && face < parsed.num_file_faces,
            "a triangle's face is a face of the file");
  }
}

inline int FuzzMesh(const uint8_t* data, size_t size, MeshFormat format) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  MeshLimits limits;
  limits.max_vertices = 100'000;
  limits.max_faces = 100'000;
  limits.max_polygon_vertices = 1'000;
  limits.max_line_bytes = 10'000;
  for (const MeshFormat told : {format, MeshFormat::kUnknown}) {
    const absl::StatusOr<ParsedMesh> parsed = ParseMesh(bytes, told, limits);
    if (!parsed.ok()) {
      CheckError(parsed.status());
      continue;
    }
    CheckParsed(*parsed);
    for (const MeshFormat other :
         {MeshFormat::kOff, MeshFormat::kObj, MeshFormat::kPly}) {
      const absl::StatusOr<std::string> written =
          SerializeMesh(parsed->mesh, other);
      Require(written.ok(), "a parsed mesh can be written");
      const absl::StatusOr<ParsedMesh> again = ParseMesh(*written);
      Require(again.ok(), "a written mesh can be read");
      Require(
          again->mesh.V == parsed->mesh.V && again->mesh.F == parsed->mesh.F,
          "a written mesh reads back the same");
    }
  }
  return 0;
}

}  // namespace argmesh

#endif  // ARGMESH_TESTS_FUZZ_FUZZ_MESH_H_
