// Normals that are smooth over gently bent surface and break at creases.
//
// Corners at equal positions belong together even where the mesh repeats the
// vertex, so triangle soup shades smoothly too.
// Cost     O(n log n + corners * valence); fans of more than 64 faces keep
//          their faces' normals. Thread-safe.
#ifndef ARGMESH_CLIENT_PICTURE_CORNER_NORMALS_H_
#define ARGMESH_CLIENT_PICTURE_CORNER_NORMALS_H_

#include <Eigen/Core>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// Unit normals, three per face in the order of its corners; zero for faces
// without area. Faces bent by more than `crease_degrees` do not mix.
std::vector<Eigen::Vector3f> ComputeCornerNormals(const TriangleMesh& mesh,
                                                  double crease_degrees = 38);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_CORNER_NORMALS_H_
