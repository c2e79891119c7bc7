// Pieces cut out of surfaces, to be looked for in them.
#ifndef ARGMESH_TESTS_BENCHMARK_CUT_PIECES_H_
#define ARGMESH_TESTS_BENCHMARK_CUT_PIECES_H_

#include <Eigen/Core>
#include <cstdint>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// The connected piece of the largest area; no faces of a mesh without any.
TriangleMesh LargestPiece(const TriangleMesh& mesh);

// The largest connected piece of what lies lowest along `direction`, clipped
// at the plane where it makes up `share` (0 .. 1) of the area.
TriangleMesh CutByShare(const TriangleMesh& mesh,
                        const Eigen::Vector3d& direction, double share);

Eigen::Vector3d RandomDirection(uint64_t seed);

// The flattest of 60 seeded patches: faces within `radius` (in square roots
// of the area) of one and facing as it does. What no search should find.
TriangleMesh FlattestDisc(const TriangleMesh& mesh, double radius,
                          uint64_t seed);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_BENCHMARK_CUT_PIECES_H_
