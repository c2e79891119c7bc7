#include "server/engine/uid.h"

#include <array>
#include <cctype>
#include <cstdint>
#include <random>

namespace argmesh {
namespace {

constexpr size_t kUidLength = 36;

bool IsDash(size_t position) {
  return position == 8 || position == 13 || position == 18 || position == 23;
}

}  // namespace

std::string MakeUid() {
  std::random_device device;  // getrandom or rdrand; never a fixed seed here
  std::array<uint8_t, 16> bytes{};
  for (size_t i = 0; i < bytes.size(); i += 4) {
    const uint32_t word = device();
    for (size_t b = 0; b < 4; ++b) {
      bytes[i + b] = static_cast<uint8_t>(word >> (8 * b));
    }
  }
  bytes[6] = static_cast<uint8_t>((bytes[6] & 0x0F) | 0x40);
  bytes[8] = static_cast<uint8_t>((bytes[8] & 0x3F) | 0x80);
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const uint8_t byte : bytes) {
    if (IsDash(text.size())) text.push_back('-');
    text.push_back(kDigits[byte >> 4]);
    text.push_back(kDigits[byte & 0xF]);
  }
  return text;
}

bool IsUid(std::string_view text) {
  if (text.size() != kUidLength) return false;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (IsDash(i) ? c != '-' : std::isxdigit(c) == 0) return false;
  }
  return true;
}

}  // namespace argmesh
