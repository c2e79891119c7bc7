// Mean distance along a surface, from points spread over it alone: the cost
// does not grow with the mesh, and soup is as good as a closed surface.
#ifndef ARGMESH_CORE_SIGNATURE_POINT_GEODESICS_H_
#define ARGMESH_CORE_SIGNATURE_POINT_GEODESICS_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"

namespace argmesh {

// For each of the first 2,048 points the mean distance from 32 of them.
// Points closer than 0.06 are linked unless their normals oppose each other, as
// those on the two sides of a sheet do. Points that no path joins are as far
// apart as a straight line.
//
// Input    at least 2,048 points spread evenly over a surface of area 1, every
//          head of the list over all of it; unit normals.
// Repeats  equal input gives bit-equal output.
// Fails    kCancelled, kDeadlineExceeded
// Cost     about 20 ms. Thread-safe.
absl::StatusOr<std::vector<float>> MeanPointGeodesics(
    std::span<const Eigen::Vector3f> positions,
    std::span<const Eigen::Vector3f> normals, const StopToken& stop);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_POINT_GEODESICS_H_
