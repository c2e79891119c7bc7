// Windows and window words as stored bytes: sealed, versioned, checksummed.
// The layout is in docs/formats.md.
//
// Fails    kDataLoss            damaged; names the data and the place
//          kFailedPrecondition  sound bytes of another version; names both
// Cost     O(bytes): words about 2.7 KB, windows about 160 KB a shape.
//          Thread-safe.
#ifndef ARGMESH_CORE_CONTAINMENT_WINDOW_CODEC_H_
#define ARGMESH_CORE_CONTAINMENT_WINDOW_CODEC_H_

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/containment/window_set.h"
#include "core/containment/window_words.h"

namespace argmesh {

// Of both blobs. Changes with the layout, the codebook and the extraction.
inline constexpr uint32_t kWindowsVersion = 1;

std::string SerializeWindowWords(const WindowWords& words);
absl::StatusOr<WindowWords> ParseWindowWords(std::string_view bytes);

std::string SerializeTargetWindows(const TargetWindows& windows);
absl::StatusOr<TargetWindows> ParseTargetWindows(std::string_view bytes);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_WINDOW_CODEC_H_
