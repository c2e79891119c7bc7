// Which side of an open piece of surface is its outside.
//
// A repair turns closed pieces outwards and leaves open ones as most of their
// area came. An open piece that nearly encloses a volume has an outside all
// the same: the sign of that volume once its borders are closed by cones.
#ifndef ARGMESH_CORE_CONTAINMENT_OPEN_ORIENTATION_H_
#define ARGMESH_CORE_CONTAINMENT_OPEN_ORIENTATION_H_

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// Makes every piece (connected across edges of two faces) consistent and flips
// each that has a border and encloses, so closed, a negative volume of more
// than a tenth of a ball of its area. Flatter pieces stay as they are.
//
// Cost     O(m). Thread-safe.
void OrientOpenPieces(TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_OPEN_ORIENTATION_H_
