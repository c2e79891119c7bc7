// The envelope of stored bytes: magic, version, length and CRC-32C in front
// of a payload.
#ifndef ARGMESH_CORE_BASE_SEALED_BYTES_H_
#define ARGMESH_CORE_BASE_SEALED_BYTES_H_

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace argmesh {

inline constexpr size_t kSealBytes = 20;

// 16 bytes of fields and the checksum of them and the payload. `magic` has 4
// characters.
std::string SealBytes(std::string_view magic, uint32_t version,
                      std::string_view payload);

// The payload, a view into `bytes`.
//
// Fails    kFailedPrecondition  another version
//          kDataLoss            another magic or length, or a wrong checksum
// `what` names the data in the message.
absl::StatusOr<std::string_view> OpenSealedBytes(std::string_view what,
                                                 std::string_view magic,
                                                 uint32_t version,
                                                 std::string_view bytes);

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_SEALED_BYTES_H_
