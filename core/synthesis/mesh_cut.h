// Parts of surfaces: what lies on one side of a plane.
//
// Output   the surface clipped at the plane and left open there; vertices on
//          cut edges are shared, vertices no face uses are gone.
// Repeats  equal input gives bit-equal output.
// Cost     O(n + m). Thread-safe.
#ifndef ARGMESH_CORE_SYNTHESIS_MESH_CUT_H_
#define ARGMESH_CORE_SYNTHESIS_MESH_CUT_H_

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// The points with normal . x >= offset are kept; `normal` of any length.
struct CutPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0;
};

TriangleMesh CutByPlane(const TriangleMesh& mesh, const CutPlane& plane);

// The half beyond the middle of the bounding box on axis 0, 1 or 2.
TriangleMesh CutHalf(const TriangleMesh& mesh, int axis);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_MESH_CUT_H_
