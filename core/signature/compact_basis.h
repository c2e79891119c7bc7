// Signatures as 64 bytes: coordinates in the directions in which the
// signatures of a collection differ most.
//
// Centre, project on the first principal axes, scale to unit length, round to
// 8 bits; no whitening, which loses more than the projection. Vectors of
// different bases cannot be compared.
#ifndef ARGMESH_CORE_SIGNATURE_COMPACT_BASIS_H_
#define ARGMESH_CORE_SIGNATURE_COMPACT_BASIS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/signature/shape_signature.h"

namespace argmesh {

inline constexpr int kCompactDims = 64;

using CompactVector = std::array<int8_t, kCompactDims>;

struct CompactBasis {
  Eigen::VectorXf mean;  // kSignatureDims
  // kSignatureDims x 1 .. kCompactDims, orthonormal columns, most important
  // first. Signs are fixed by the largest entry of each.
  Eigen::MatrixXf axes;
};

// Of at most 4,096 signatures, evenly chosen when there are more.
//
// Repeats  equal signatures in equal order give bit-equal output.
// Fails    kFailedPrecondition  fewer than 2 different signatures
//          kCancelled, kDeadlineExceeded
// Cost     O(n), about 0.5 s for 1,000 signatures. Thread-safe.
absl::StatusOr<CompactBasis> FitCompactBasis(
    std::span<const ShapeSignature* const> signatures,
    const StopToken& stop = {});

// Zero when the signature is the mean. Cost about 50 us.
CompactVector ProjectSignature(const CompactBasis& basis,
                               const ShapeSignature& signature);

// The cosine of two vectors of one basis, -1 .. 1; symmetric. For choosing
// candidates: not on the scale of SignatureSimilarity. Cost about 10 ns.
double CompactSimilarity(const CompactVector& a, const CompactVector& b);

// Sealed bytes, about 480 KB: floats.
//
// Fails    kDataLoss            damaged bytes
//          kFailedPrecondition  a basis of another kSignatureVersion
std::string EncodeCompactBasis(const CompactBasis& basis);
absl::StatusOr<CompactBasis> DecodeCompactBasis(std::string_view bytes);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_COMPACT_BASIS_H_
