// The OBJ format of Wavefront: `v` and `f` make the mesh. Texture, normal,
// group and material statements are passed over and no file that they name is
// ever opened; lines, points, curves and unknown statements are counted as
// ignored. A face may name vertices that come later in the file.
//
// Source   Wavefront Advanced Visualizer manual, appendix B1.
// Fails    as mesh_format.h.
#ifndef ARGMESH_CORE_MESH_MESH_OBJ_H_
#define ARGMESH_CORE_MESH_MESH_OBJ_H_

#include <string_view>

#include "absl/status/statusor.h"
#include "core/mesh/mesh_format.h"

namespace argmesh {

// The bytes begin, after comments, with a statement of the format.
bool LooksLikeObj(std::string_view bytes);

absl::StatusOr<ParsedMesh> ParseObj(std::string_view bytes,
                                    const MeshLimits& limits);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_OBJ_H_
