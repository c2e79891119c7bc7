// Brings a mesh to a form that does not depend on how it was moved, scaled and
// numbered: copies become equal bit for bit in nearly all cases.
//
// The area centroid goes to the origin, the area to 1, the principal axes of
// the surface's covariance to x, y, z, largest first; the two along which it is
// most lopsided point to the side of the positive third moment. Positions are
// rounded to a grid of 2^-22, vertices sorted along an oblique direction and
// faces by vertices.
//
// Input    any triangles; a mirrored copy is another shape.
// Output   the same vertices and faces in another order; unused vertices are
//          dropped. Vertices that fall on the same grid point stay apart, so
//          a manifold stays one; a face can so lose its area.
// Ignores  translation, rotation, uniform scale, order of vertices and faces.
// Repeats  a copy differs only where a coordinate lies within rounding of the
//          middle between grid points, or where `ambiguous` is set.
// Fails    kInvalidArgument     CheckMesh fails
//          kFailedPrecondition  no face of positive area
// Cost     O((n + m) log(n + m)). Thread-safe.
#ifndef ARGMESH_CORE_MESH_MESH_CANONICAL_H_
#define ARGMESH_CORE_MESH_MESH_CANONICAL_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mesh/mesh_smooth.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct CanonicalMesh {
  TriangleMesh mesh;
  // For each face of `mesh` the face of the input it is.
  std::vector<int32_t> source_face;
  // x_canonical = rotation * unit_area(x), before rounding.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  UnitAreaTransform unit_area;
  // The axes or their signs are not determined by the surface: two extents are
  // nearly equal, or it is nearly symmetric about two planes. Copies can then
  // differ.
  bool ambiguous = false;
};

absl::StatusOr<CanonicalMesh> CanonicalizeMesh(const TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_CANONICAL_H_
