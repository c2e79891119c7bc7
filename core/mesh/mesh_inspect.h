// Counts what is unusual in a mesh without changing it: the "found" half of a
// MeshReport. Cost O((n + m) log m). Thread-safe.
#ifndef ARGMESH_CORE_MESH_MESH_INSPECT_H_
#define ARGMESH_CORE_MESH_MESH_INSPECT_H_

#include "core/mesh/mesh_report.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

MeshReport InspectMesh(const TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_INSPECT_H_
