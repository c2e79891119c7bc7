// Points spread evenly over a signature's surface.
#ifndef ARGMESH_CORE_SIGNATURE_SURFACE_POINTS_H_
#define ARGMESH_CORE_SIGNATURE_SURFACE_POINTS_H_

#include <Eigen/Core>
#include <vector>

#include "core/signature/signature_surface.h"

namespace argmesh {

inline constexpr int kSurfacePoints = 8192;

// Any head of the lists is spread over the whole surface.
struct SurfacePoints {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;  // of the faces, unit
};

// kSurfacePoints points, one in each of as many equal steps of area along the
// list of faces, then shuffled; the seed is fixed.
//
// Repeats  equal input gives bit-equal output. Cost O(m + points).
SurfacePoints SpreadPoints(const SignatureSurface& surface);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_SURFACE_POINTS_H_
