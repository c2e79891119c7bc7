// Face labels compressed with Zstandard: a shape of a million faces has
// megabytes of labels that say little.
#ifndef ARGMESH_SERVER_STORAGE_LABEL_COMPRESSION_H_
#define ARGMESH_SERVER_STORAGE_LABEL_COMPRESSION_H_

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace argmesh {

// Of the labels of one shape, not compressed.
inline constexpr int64_t kMaxLabelBytes = 512LL << 20;

// Fails    kResourceExhausted MESH_TOO_LARGE  more than kMaxLabelBytes
absl::StatusOr<std::string> CompressLabels(std::string_view labels);

// `raw_bytes` as stored beside them; checked against the bound and against the
// frame before anything is allocated.
// Fails    kDataLoss
absl::StatusOr<std::string> DecompressLabels(std::string_view compressed,
                                             int64_t raw_bytes);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_LABEL_COMPRESSION_H_
