#include "server/telemetry/trace_context.h"

#include <algorithm>

#include "server/engine/uid.h"

namespace argmesh {
namespace {

// version "-" trace id "-" parent id "-" flags
constexpr size_t kTraceBegin = 3;
constexpr size_t kTraceDigits = 32;
constexpr size_t kParentBegin = kTraceBegin + kTraceDigits + 1;
constexpr size_t kParentDigits = 16;
constexpr size_t kFlagsBegin = kParentBegin + kParentDigits + 1;
constexpr size_t kHeaderSize = kFlagsBegin + 2;
constexpr char kSampledDigits[] = "13579bdf";  // last bit of the last digit

bool IsLowerHex(std::string_view text) {
  return text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool IsId(std::string_view text) {
  return IsLowerHex(text) &&
         text.find_first_not_of('0') != std::string_view::npos;
}

// A version-4 UUID has fixed digits that are not 0.
std::string RandomDigits() {
  std::string digits = MakeUid();
  std::erase(digits, '-');
  return digits;
}

}  // namespace

TraceContext ParseTraceparent(std::string_view header) {
  if (header.size() < kHeaderSize) return {};
  const std::string_view version = header.substr(0, 2);
  const bool separated = header[kTraceBegin - 1] == '-' &&
                         header[kParentBegin - 1] == '-' &&
                         header[kFlagsBegin - 1] == '-';
  if (!separated || !IsLowerHex(version) || version == "ff") return {};
  const bool longer = header.size() > kHeaderSize;
  if (longer && (version == "00" || header[kHeaderSize] != '-')) return {};
  const std::string_view trace = header.substr(kTraceBegin, kTraceDigits);
  const std::string_view parent = header.substr(kParentBegin, kParentDigits);
  const std::string_view flags = header.substr(kFlagsBegin, 2);
  if (!IsId(trace) || !IsId(parent) || !IsLowerHex(flags)) return {};
  return {.trace_id = std::string(trace),
          .parent_id = std::string(parent),
          .sampled = std::string_view(kSampledDigits).find(flags[1]) !=
                     std::string_view::npos};
}

std::string MakeTraceId() { return RandomDigits(); }

std::string MakeSpanId() { return RandomDigits().substr(0, kParentDigits); }

}  // namespace argmesh
