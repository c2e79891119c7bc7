#include "core/mesh/mesh_inspect.h"

#include "core/mesh/mesh_count.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_orient.h"
#include "core/mesh/mesh_weld.h"

namespace argmesh {

MeshReport InspectMesh(const TriangleMesh& mesh, double weld_distance) {
  WeldedMesh welded = WeldMesh(mesh, weld_distance);
  const MeshEdges edges =
      ComputeMeshEdges(welded.mesh.F, welded.mesh.num_vertices());
  MeshReport report = CountFound(mesh, welded, edges);
  report.euler_characteristic = EulerCharacteristic(welded.mesh, edges);
  report.unorientable_components =
      OrientFaces(welded.mesh, edges).unorientable_components;
  return report;
}

}  // namespace argmesh
