// In which sense a surface is not its own mirror image: numbers that change
// their sign, and nothing else, when it is mirrored.
//
// Along the principal axes x, y, z: integrals over the surface that are odd in
// each of the axes, and products of integrals that are so together. A turn of
// the frame by half a circle leaves them alone, so the signs of the axes do not
// matter; a plane of symmetry makes each of them 0. Where two axes could be
// exchanged they fade to 0.
#ifndef ARGMESH_CORE_SIGNATURE_CHIRALITY_H_
#define ARGMESH_CORE_SIGNATURE_CHIRALITY_H_

#include <array>

#include "core/mesh/triangle_mesh.h"
#include "core/signature/shape_signature.h"

namespace argmesh {

// Of a surface of positive area; -1 .. 1 each, of the order of 0.1 for shapes
// that are plainly not symmetric. Ignores translation, rotation and scale.
// Cost O(m). Thread-safe.
std::array<float, kChiralDims> MeasureChirality(const TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_CHIRALITY_H_
