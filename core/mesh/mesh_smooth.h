// Removes noise without shrinking, and brings a mesh to unit area.
#ifndef ARGMESH_CORE_MESH_MESH_SMOOTH_H_
#define ARGMESH_CORE_MESH_MESH_SMOOTH_H_

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct TaubinOptions {
  int steps = 15;       // pairs of a shrinking and a growing step, >= 0
  double lambda = 0.5;  // 0 .. 1
  double mu = -0.53;    // -1 .. -lambda
};

// Uniform-weight Taubin smoothing; boundary vertices stay where they are.
//
// Source   Taubin, "A Signal Processing Approach to Fair Surface Design",
//          SIGGRAPH 1995.
// Cost     O(steps * m). Thread-safe.
void SmoothTaubin(TriangleMesh& mesh, const TaubinOptions& options = {});

// x_unit = (x - centroid) * scale.
struct UnitAreaTransform {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double scale = 1;
};

// Moves the area centroid to the origin and scales the area to 1. The area
// must be positive.
UnitAreaTransform NormalizeToUnitArea(TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_SMOOTH_H_
