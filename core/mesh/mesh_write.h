// Meshes to bytes: OFF, OBJ, PLY and STL, with or without face colours.
//
// Coordinates are written so that reading them gives the same doubles (text
// formats, binary PLY) or the nearest floats (binary STL). Cost O(n + m).
#ifndef ARGMESH_CORE_MESH_MESH_WRITE_H_
#define ARGMESH_CORE_MESH_MESH_WRITE_H_

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

using RgbColor = std::array<uint8_t, 3>;

// OFF and OBJ as text, PLY and STL binary little-endian. kInvalidArgument for
// MeshFormat::kUnknown and for what ParseMesh would refuse: a face's vertex
// that is none, a coordinate beyond the range of float.
absl::StatusOr<std::string> SerializeMesh(const TriangleMesh& mesh,
                                          MeshFormat format);

// Binary PLY with one colour per face; `face_colors` has one per face and the
// mesh passes CheckMesh.
std::string SerializeColoredPly(const TriangleMesh& mesh,
                                std::span<const RgbColor> face_colors);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_WRITE_H_
