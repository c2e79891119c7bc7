// The OFF format of Geomview as text: OFF, COFF, NOFF, STOFF and their
// combinations, counts on the first or a later line, the word OFF itself
// optional. Colours, normals and texture coordinates are skipped.
//
// Source   Geomview manual, "OFF: Object File Format".
// Fails    as mesh_format.h; OFF BINARY, 4OFF and nOFF are kInvalidArgument.
#ifndef ARGMESH_CORE_MESH_MESH_OFF_H_
#define ARGMESH_CORE_MESH_MESH_OFF_H_

#include <string_view>

#include "absl/status/statusor.h"
#include "core/mesh/mesh_format.h"

namespace argmesh {

// The bytes begin, after comments, with a word of the OFF family or a number.
bool LooksLikeOff(std::string_view bytes);

absl::StatusOr<ParsedMesh> ParseOff(std::string_view bytes,
                                    const MeshLimits& limits);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_OFF_H_
