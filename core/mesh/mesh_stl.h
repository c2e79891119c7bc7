// The STL format, ascii and binary. Binary is what has exactly the size that
// its facet count asks for, whatever its first bytes say; else what begins
// with "solid" is text. Several solids of a text file make one mesh. Normals
// are not read.
//
// The corners of the facets are welded where their coordinates are equal; the
// vertices come in the order of their first use.
//
// Source   3D Systems, "StereoLithography Interface Specification", 1989.
// Fails    as mesh_format.h.
// Cost     O(m log m) for m facets.
#ifndef ARGMESH_CORE_MESH_MESH_STL_H_
#define ARGMESH_CORE_MESH_MESH_STL_H_

#include <string_view>

#include "absl/status/statusor.h"
#include "core/mesh/mesh_format.h"

namespace argmesh {

// The size is 84 + 50 * n with n the count at byte 80.
bool LooksLikeBinaryStl(std::string_view bytes);

// The bytes begin with the word "solid", in any case, and hold no NUL there.
bool LooksLikeAsciiStl(std::string_view bytes);

absl::StatusOr<ParsedMesh> ParseStl(std::string_view bytes,
                                    const MeshLimits& limits);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_STL_H_
