// The beginning of a text, for messages that must not be as long as what a
// client sent. Cut between characters: a message with half of one could not be
// read by protobuf's clients.
#ifndef ARGMESH_CORE_BASE_UTF8_PREFIX_H_
#define ARGMESH_CORE_BASE_UTF8_PREFIX_H_

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace argmesh {

// At most `max_bytes` of `text`, which is UTF-8.
inline std::string_view Utf8Prefix(std::string_view text, size_t max_bytes) {
  if (text.size() <= max_bytes) return text;
  constexpr uint8_t kTop = 0xC0;
  constexpr uint8_t kContinuation = 0x80;
  size_t end = max_bytes;
  while (end > 0 && (static_cast<uint8_t>(text[end]) & kTop) == kContinuation) {
    --end;
  }
  return text.substr(0, end);
}

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_UTF8_PREFIX_H_
