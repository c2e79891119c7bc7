// Counts what is unusual in a mesh without changing it: the "found" half of a
// MeshReport.
//
// Connectivity is counted after welding vertices closer than `weld_distance`
// sqrt(surface area) and without degenerate and duplicate faces, which are
// counted as if they had been repaired. The Euler characteristic is that of
// the welded surface.
//
// Input    CheckMesh(mesh) holds.
// Cost     O((n + m) log m). Thread-safe.
#ifndef ARGMESH_CORE_MESH_MESH_INSPECT_H_
#define ARGMESH_CORE_MESH_MESH_INSPECT_H_

#include "core/mesh/mesh_report.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

MeshReport InspectMesh(const TriangleMesh& mesh, double weld_distance = 1e-5);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_INSPECT_H_
