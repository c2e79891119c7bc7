// Weighted sums of squared distances to planes, as a quadratic form.
//
// Source   Garland, Heckbert, "Surface Simplification Using Quadric Error
//          Metrics", SIGGRAPH 1997.
#ifndef ARGMESH_CORE_MESH_PLANE_QUADRIC_H_
#define ARGMESH_CORE_MESH_PLANE_QUADRIC_H_

#include <Eigen/Core>
#include <vector>

#include "core/mesh/mesh_edges.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

class PlaneQuadric {
 public:
  // The plane through `point` with unit `normal`.
  void AddPlane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point,
                double weight);
  PlaneQuadric& operator+=(const PlaneQuadric& other);

  double weight() const { return weight_; }
  // Weighted sum at x; rounding can make it slightly negative.
  double SumAt(const Eigen::Vector3d& x) const;
  // Where SumAt(x) + pull * weight() * |x - rest|^2 is least; pull > 0 and
  // weight() > 0.
  Eigen::Vector3d Lowest(const Eigen::Vector3d& rest, double pull) const;

 private:
  Eigen::Matrix3d A_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b_ = Eigen::Vector3d::Zero();
  double c_ = 0;
  double weight_ = 0;
};

// By vertex: planes of the faces around it, a third of the area each, and at
// boundary edges the plane through the edge across its face, weighted by the
// squared length.
std::vector<PlaneQuadric> ComputeVertexQuadrics(const TriangleMesh& mesh,
                                                const MeshEdges& edges);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_PLANE_QUADRIC_H_
