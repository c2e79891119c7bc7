// Well-formed signatures made from a seed, for tests that need no mesh.
#ifndef ARGMESH_TESTS_UNIT_CORE_SIGNATURE_RANDOM_SIGNATURE_H_
#define ARGMESH_TESTS_UNIT_CORE_SIGNATURE_RANDOM_SIGNATURE_H_

#include <cstdint>

#include "core/signature/shape_signature.h"

namespace argmesh {

// Satisfies CheckShapeSignature; equal seeds give equal signatures.
ShapeSignature MakeRandomSignature(uint64_t seed);

// The signature with every part turned by about `amount` towards another one.
ShapeSignature PerturbSignature(const ShapeSignature& signature, float amount,
                                uint64_t seed);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_UNIT_CORE_SIGNATURE_RANDOM_SIGNATURE_H_
