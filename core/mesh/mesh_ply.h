// The PLY format: text, little-endian and big-endian binary, scalar and list
// properties of every type, elements in any order. Read are `vertex` (x, y,
// z), `face` (vertex_indices or vertex_index) and `tristrips` (the same, -1
// begins a new strip); everything else is skipped.
//
// Source   Turk, "The PLY Polygon File Format", Stanford 1994.
// Fails    as mesh_format.h.
#ifndef ARGMESH_CORE_MESH_MESH_PLY_H_
#define ARGMESH_CORE_MESH_MESH_PLY_H_

#include <string_view>

#include "absl/status/statusor.h"
#include "core/mesh/mesh_format.h"

namespace argmesh {

absl::StatusOr<ParsedMesh> ParsePly(std::string_view bytes,
                                    const MeshLimits& limits);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_PLY_H_
