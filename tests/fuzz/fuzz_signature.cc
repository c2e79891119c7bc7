// Stored signatures and bases: whatever the bytes, an error or something whole.
//
// The checksum would keep the fuzzer out, so the payload is sealed here.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/base/sealed_bytes.h"
#include "core/signature/codebook.h"
#include "core/signature/compact_basis.h"
#include "core/signature/signature_codec.h"
#include "core/signature/signature_similarity.h"

namespace argmesh {
namespace {

void FuzzSignature(std::string_view payload) {
  const auto signature =
      DecodeSignature(SealBytes("ARGS", kSignatureVersion, payload));
  if (!signature.ok()) return;
  if (!CheckShapeSignature(*signature).ok()) std::abort();
  if (SignatureSimilarity(*signature, *signature) != 1) std::abort();
}

}  // namespace
}  // namespace argmesh

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  argmesh::FuzzSignature(bytes);
  (void)argmesh::DecodeSignature(bytes);
  (void)argmesh::DecodeCompactBasis(
      argmesh::SealBytes("ARGB", argmesh::kSignatureVersion, bytes));
  (void)argmesh::DecodeCodebook(
      argmesh::SealBytes("ARGC", argmesh::kSignatureVersion, bytes));
  return 0;
}
