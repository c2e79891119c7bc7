// CRC-32C (Castagnoli, RFC 3720), the checksum of every stored graph.
//
// Detects damage, not tampering. Cost O(bytes). Thread-safe.
#ifndef ARGMESH_CORE_BASE_CRC32C_H_
#define ARGMESH_CORE_BASE_CRC32C_H_

#include <cstdint>
#include <string_view>

namespace argmesh {

uint32_t ComputeCrc32c(std::string_view bytes);

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_CRC32C_H_
