// Mean and Gaussian curvature measured in a geodesic ball around each vertex:
// interpolated corrected curvature measures.
//
// Source   Lachaud, Romon, Thibert, Coeurjolly, "Interpolated Corrected
//          Curvature Measures for Polygonal Surfaces", CGF (SGP) 2020.
// Input    an oriented mesh, unit vertex normals pointing outwards.
// Output   mean > 0 and gaussian > 0 on a convex surface: a sphere of radius r
//          has mean 1/r and gaussian 1/r^2. 0 where the ball has no area.
// Cost     O(n k) for k samples in a ball. Thread-safe.
#ifndef ARGMESH_CORE_GEOMETRY_CURVATURE_H_
#define ARGMESH_CORE_GEOMETRY_CURVATURE_H_

#include <Eigen/Core>

#include "core/geometry/surface_graph.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct Curvatures {
  Eigen::VectorXd mean;      // H, 1/length
  Eigen::VectorXd gaussian;  // K, 1/length^2
};

// `radius` of the ball in the mesh's unit, >= 0; 0 takes the faces around the
// vertex.
Curvatures ComputeCurvatures(const TriangleMesh& mesh,
                             const VertexMatrix& normals,
                             const SurfaceGraph& graph, double radius);

// Vertex normals averaged by area over a geodesic ball of `radius`.
VertexMatrix ComputeSmoothedNormals(const TriangleMesh& mesh,
                                    const VertexMatrix& normals,
                                    const Eigen::VectorXd& areas,
                                    const SurfaceGraph& graph, double radius);

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_CURVATURE_H_
