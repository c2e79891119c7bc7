// Areas and normals of a triangle mesh. Cost O(n + m). Thread-safe.
#ifndef ARGMESH_CORE_GEOMETRY_AREA_H_
#define ARGMESH_CORE_GEOMETRY_AREA_H_

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// m areas, >= 0.
Eigen::VectorXd ComputeFaceAreas(const TriangleMesh& mesh);

// n areas summing to the surface's: the mixed Voronoi area of Meyer et al.,
// "Discrete Differential-Geometry Operators", VisMath 2002.
Eigen::VectorXd ComputeVertexAreas(const TriangleMesh& mesh);

// n x 3 unit normals, area-weighted over the faces around; zero where every
// face around is degenerate.
VertexMatrix ComputeVertexNormals(const TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_AREA_H_
