#include "client/request_id.h"

#include <cstdint>
#include <random>

#include "absl/strings/str_format.h"

namespace argmesh {

std::string NewRequestId() {
  std::random_device entropy;
  const auto word = [&entropy] {
    return (uint64_t{entropy()} << 32) | uint64_t{entropy()};
  };
  const uint64_t high = (word() & ~uint64_t{0xf000}) | 0x4000;
  const uint64_t low = (word() & (~uint64_t{0} >> 2)) | (uint64_t{1} << 63);
  return absl::StrFormat("%08x-%04x-%04x-%04x-%012x", high >> 32,
                         high >> 16 & 0xffff, high & 0xffff, low >> 48,
                         low & ((uint64_t{1} << 48) - 1));
}

}  // namespace argmesh
