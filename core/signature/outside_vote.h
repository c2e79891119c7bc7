// Which side of an open piece of surface is its outside.
//
// A repair turns closed pieces outwards and leaves open ones as most of their
// area came. Rays leave from both sides of points all over the open pieces; a
// piece is turned when more of them escape to infinity from its back.
#ifndef ARGMESH_CORE_SIGNATURE_OUTSIDE_VOTE_H_
#define ARGMESH_CORE_SIGNATURE_OUTSIDE_VOTE_H_

#include "absl/status/status.h"
#include "core/base/stop_token.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// Flips whole pieces (connected across edges of two faces that wind alike) of
// `mesh`, which has area 1. Pieces without a boundary, and those whose sides
// see equally much, stay as they are.
//
// Repeats  equal input gives bit-equal output.
// Fails    kInternal  the ray tracer could not be set up
//          kCancelled, kDeadlineExceeded
// Cost     O(m + 4,096 points x 16 rays log m), at most about 40 ms.
absl::Status TurnOpenPiecesOut(const StopToken& stop, TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_OUTSIDE_VOTE_H_
