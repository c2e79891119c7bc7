// The stored bytes of a signature (docs/formats.md): half precision, 3.7 KB.
//
// Versioned, checksummed with CRC-32C, bounds-checked. Encode then Decode
// gives the same signature to the bit when it was computed by
// ComputeShapeSignature. Cost O(bytes). Thread-safe.
//
// Fails    kDataLoss            damaged bytes
//          kFailedPrecondition  another version: compute the signature again
#ifndef ARGMESH_CORE_SIGNATURE_SIGNATURE_CODEC_H_
#define ARGMESH_CORE_SIGNATURE_SIGNATURE_CODEC_H_

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/signature/shape_signature.h"

namespace argmesh {

// Of the bytes, of the codebook and of everything that is computed: whatever
// changes a signature raises it. Signatures of different versions cannot be
// compared.
inline constexpr uint32_t kSignatureVersion = 1;

// `signature` satisfies CheckShapeSignature.
std::string EncodeSignature(const ShapeSignature& signature);
absl::StatusOr<ShapeSignature> DecodeSignature(std::string_view bytes);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_SIGNATURE_CODEC_H_
