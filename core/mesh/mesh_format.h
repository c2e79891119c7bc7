// Reading meshes from bytes of an untrusted origin.
//
// OFF (also OFF with counts on its first line, COFF, NOFF, comments), OBJ
// (v, v/vt, v//vn, negative indices, polygons; `mtllib` is never opened), PLY
// (ascii, little and big endian, triangle strips), STL (ascii and binary, told
// apart by size). Polygons are triangulated (fan or ear clipping); the vertices
// of an STL file are its distinct positions in the order of their first use.
// Every count is checked against the bytes left before anything is allocated.
//
// Fails    kInvalidArgument     malformed; the message names line or byte
//          kResourceExhausted   over a limit; names value and limit
// Cost     O(bytes) time, at most about 20 times the bytes in memory.
//          Thread-safe.
#ifndef ARGMESH_CORE_MESH_MESH_FORMAT_H_
#define ARGMESH_CORE_MESH_MESH_FORMAT_H_

#include <cstdint>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

enum class MeshFormat { kUnknown, kOff, kObj, kPly, kStl };

// "off", "obj", "ply", "stl" or "unknown".
std::string_view MeshFormatName(MeshFormat format);

// From the file name's extension, any case; kUnknown for others.
MeshFormat MeshFormatFromPath(std::string_view path);

struct MeshLimits {
  int64_t max_bytes = 512LL << 20;        // of the file
  int64_t max_vertices = 20'000'000;      // as declared or found
  int64_t max_faces = 40'000'000;         // triangles after triangulation
  int64_t max_polygon_vertices = 10'000;  // valence of one face
  int64_t max_line_bytes = 1 << 20;       // of a text format
};

struct ParsedMesh {
  TriangleMesh mesh;
  // For each triangle the face of the file it comes from, counted from 0.
  std::vector<int32_t> file_face;
  int32_t num_file_faces = 0;
  MeshFormat format = MeshFormat::kUnknown;

  // Faces of fewer than 3 vertices; they have no triangle.
  int64_t skipped_file_faces = 0;
  // Polygons that cross themselves or have no area; triangulated all the same.
  int64_t irregular_file_faces = 0;
  // What is no surface or not understood: OBJ lines, points, curves and
  // unknown statements; PLY elements beside vertices, faces and strips, lines
  // of more values than the PLY header declares.
  int64_t ignored_statements = 0;
};

// `format` kUnknown: told from the bytes.
absl::StatusOr<ParsedMesh> ParseMesh(std::string_view bytes,
                                     MeshFormat format = MeshFormat::kUnknown,
                                     const MeshLimits& limits = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_FORMAT_H_
