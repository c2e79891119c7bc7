// What a repair and an inspection both count on a welded mesh.
#ifndef ARGMESH_CORE_MESH_MESH_COUNT_H_
#define ARGMESH_CORE_MESH_MESH_COUNT_H_

#include <cstdint>

#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/mesh_weld.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// All of the "found" half but unorientable_components and
// euler_characteristic, and what welding dropped. `edges` are those of
// welded.mesh. Cost O(n + m). Thread-safe.
MeshReport CountFound(const TriangleMesh& given, const WeldedMesh& welded,
                      const MeshEdges& edges);

// V - E + F; every vertex must be used.
int64_t EulerCharacteristic(const TriangleMesh& mesh, const MeshEdges& edges);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_COUNT_H_
