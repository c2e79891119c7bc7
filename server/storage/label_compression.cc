#include "server/storage/label_compression.h"

#include <zstd.h>

#include "absl/strings/str_format.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

constexpr int kCompressionLevel = 3;

}  // namespace

absl::StatusOr<std::string> CompressLabels(std::string_view labels) {
  if (static_cast<int64_t>(labels.size()) > kMaxLabelBytes) {
    return MakeError(ErrorReason::kMeshTooLarge,
                     absl::StrFormat("the labels of the faces take %d bytes, "
                                     "more than %d",
                                     labels.size(), kMaxLabelBytes));
  }
  std::string compressed(ZSTD_compressBound(labels.size()), '\0');
  const size_t size =
      ZSTD_compress(compressed.data(), compressed.size(), labels.data(),
                    labels.size(), kCompressionLevel);
  if (ZSTD_isError(size) != 0) {
    return MakeError(ErrorReason::kInternal, ZSTD_getErrorName(size));
  }
  compressed.resize(size);
  return compressed;
}

absl::StatusOr<std::string> DecompressLabels(std::string_view compressed,
                                             int64_t raw_bytes) {
  const unsigned long long declared =
      ZSTD_getFrameContentSize(compressed.data(), compressed.size());
  if (raw_bytes < 0 || raw_bytes > kMaxLabelBytes ||
      declared != static_cast<unsigned long long>(raw_bytes)) {
    return absl::DataLossError(absl::StrFormat(
        "labels: %d bytes are stored for, which the frame does not hold",
        raw_bytes));
  }
  std::string labels(static_cast<size_t>(raw_bytes), '\0');
  const size_t size = ZSTD_decompress(labels.data(), labels.size(),
                                      compressed.data(), compressed.size());
  if (ZSTD_isError(size) != 0 || size != labels.size()) {
    return absl::DataLossError("labels: the compressed bytes are damaged");
  }
  return labels;
}

}  // namespace argmesh
