// The header of a PLY file: what its elements and properties are and where the
// body begins.
//
// Source   Turk, "The PLY Polygon File Format", Stanford 1994.
// Fails    as mesh_format.h.
#ifndef ARGMESH_CORE_MESH_MESH_PLY_HEADER_H_
#define ARGMESH_CORE_MESH_MESH_PLY_HEADER_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mesh/mesh_format.h"

namespace argmesh {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

enum class PlyScalar {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64
};

size_t PlyScalarBytes(PlyScalar type);
bool IsPlyInteger(PlyScalar type);

// Names point into the bytes of the file.
struct PlyProperty {
  std::string_view name;
  PlyScalar type = PlyScalar::kInt8;
  std::optional<PlyScalar> count_type;  // of a list; an integer type
};

struct PlyElement {
  std::string_view name;
  int64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  size_t body_offset = 0;
  int64_t body_line = 0;

  // Null when there is none; the header has no two elements of one name among
  // those that make the mesh.
  const PlyElement* FindElement(std::string_view name) const;
};

// The bytes begin with the word "ply" on a line of its own.
bool LooksLikePly(std::string_view bytes);

absl::StatusOr<PlyHeader> ParsePlyHeader(std::string_view bytes,
                                         const MeshLimits& limits);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_PLY_HEADER_H_
