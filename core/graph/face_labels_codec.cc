#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/sealed_bytes.h"
#include "core/base/status_macros.h"
#include "core/graph/graph_codec.h"

namespace argmesh {
namespace {

constexpr std::string_view kLabelsMagic = "ARGL";

void WriteLabels(const std::vector<int16_t>& labels, ByteWriter& writer) {
  writer.WriteU32(static_cast<uint32_t>(labels.size()));
  writer.WriteBytes(
      std::string_view(reinterpret_cast<const char*>(labels.data()),
                       labels.size() * sizeof(int16_t)));
}

absl::StatusOr<std::vector<int16_t>> ReadLabels(ByteReader& reader) {
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t count,
                           reader.ReadCount(sizeof(int16_t)));
  ARGMESH_ASSIGN_OR_RETURN(const std::string_view bytes,
                           reader.ReadBytes(count * sizeof(int16_t)));
  std::vector<int16_t> labels(count);
  if (count > 0) std::memcpy(labels.data(), bytes.data(), bytes.size());
  for (size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < -1 || labels[i] >= kMaxGraphNodes) {
      return absl::DataLossError(
          absl::StrFormat("face labels: face %d: label %d outside -1 .. %d", i,
                          labels[i], kMaxGraphNodes - 1));
    }
  }
  return labels;
}

}  // namespace

std::string SerializeFaceLabels(const FaceLabels& labels) {
  ByteWriter writer;
  WriteLabels(labels.component, writer);
  WriteLabels(labels.uniform, writer);
  return SealBytes(kLabelsMagic, kShapeGraphVersion, writer.bytes());
}

absl::StatusOr<FaceLabels> ParseFaceLabels(std::string_view bytes) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::string_view payload,
      OpenSealedBytes("face labels", kLabelsMagic, kShapeGraphVersion, bytes));
  ByteReader reader(payload, "face labels");
  FaceLabels labels;
  ARGMESH_ASSIGN_OR_RETURN(labels.component, ReadLabels(reader));
  ARGMESH_ASSIGN_OR_RETURN(labels.uniform, ReadLabels(reader));
  ARGMESH_RETURN_IF_ERROR(reader.ExpectEnd());
  if (!labels.uniform.empty() &&
      labels.uniform.size() != labels.component.size()) {
    return absl::DataLossError(
        absl::StrFormat("face labels: %d uniform labels of %d faces",
                        labels.uniform.size(), labels.component.size()));
  }
  return labels;
}

}  // namespace argmesh
