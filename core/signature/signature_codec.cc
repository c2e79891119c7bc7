#include "core/signature/signature_codec.h"

#include <Eigen/Core>
#include <bit>
#include <cmath>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/sealed_bytes.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr std::string_view kSignatureMagic = "ARGS";
constexpr std::string_view kSignatureName = "signature";

void WriteHalves(const std::vector<float>& values, ByteWriter& writer) {
  for (const float value : values) {
    writer.WriteU16(std::bit_cast<uint16_t>(Eigen::half(value)));
  }
}

absl::StatusOr<std::vector<float>> ReadHalves(int count, ByteReader& reader) {
  std::vector<float> values;
  values.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    ARGMESH_ASSIGN_OR_RETURN(const uint16_t bits, reader.ReadU16());
    values.push_back(
        static_cast<float>(Eigen::numext::bit_cast<Eigen::half>(bits)));
  }
  return values;
}

}  // namespace

std::string EncodeSignature(const ShapeSignature& signature) {
  ByteWriter writer;
  writer.WriteU8(signature.smoothed ? 1 : 0);
  writer.WriteF32Array(signature.chirality);
  WriteHalves(signature.point, writer);
  WriteHalves(signature.view, writer);
  return SealBytes(kSignatureMagic, kSignatureVersion, writer.bytes());
}

absl::StatusOr<ShapeSignature> DecodeSignature(std::string_view bytes) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string_view payload,
                           OpenSealedBytes(kSignatureName, kSignatureMagic,
                                           kSignatureVersion, bytes));
  ByteReader reader(payload, kSignatureName);
  ShapeSignature signature;
  ARGMESH_ASSIGN_OR_RETURN(const uint8_t smoothed, reader.ReadU8());
  if (smoothed > 1) {
    return absl::DataLossError(
        absl::StrFormat("signature: smoothed is %d, not 0 or 1", smoothed));
  }
  signature.smoothed = smoothed == 1;
  for (float& value : signature.chirality) {
    ARGMESH_ASSIGN_OR_RETURN(value, reader.ReadF32());
  }
  ARGMESH_ASSIGN_OR_RETURN(signature.point, ReadHalves(kPointDims, reader));
  ARGMESH_ASSIGN_OR_RETURN(signature.view, ReadHalves(kViewDims, reader));
  ARGMESH_RETURN_IF_ERROR(reader.ExpectEnd());
  if (const absl::Status status = CheckShapeSignature(signature);
      !status.ok()) {
    return absl::DataLossError(status.message());
  }
  return signature;
}

}  // namespace argmesh
