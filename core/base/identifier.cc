#include "core/base/identifier.h"

#include <algorithm>

#include "absl/strings/str_format.h"
#include "core/base/sha256.h"
#include "core/base/utf8_prefix.h"

namespace argmesh {
namespace {

bool IsLower(char c) { return c >= 'a' && c <= 'z'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

bool IsIdentifier(std::string_view id) {
  if (id.empty() || id.size() > kMaxIdentifierLength) return false;
  if (!IsLower(id.front()) || id.back() == '-') return false;
  return std::all_of(id.begin(), id.end(), [](char c) {
    return IsLower(c) || IsDigit(c) || c == '-';
  });
}

absl::Status CheckIdentifier(std::string_view what, std::string_view id) {
  if (IsIdentifier(id)) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrFormat(
      "%s id \"%s\": 1 to %d of a-z, 0-9 and '-', beginning with a letter and "
      "not ending with '-'",
      std::string(what), std::string(Utf8Prefix(id, 2 * kMaxIdentifierLength)),
      kMaxIdentifierLength));
}

std::string IdentifierFromPath(std::string_view relative_path) {
  std::string plain;
  for (const char c : relative_path) {
    if (IsLower(c) || IsDigit(c)) {
      plain.push_back(c);
    } else if (c >= 'A' && c <= 'Z') {
      plain.push_back(static_cast<char>(c - 'A' + 'a'));
    } else if (!plain.empty() && plain.back() != '-') {
      plain.push_back('-');
    }
  }
  while (!plain.empty() && plain.back() == '-') plain.pop_back();
  if (plain == relative_path && IsIdentifier(plain)) return plain;

  constexpr size_t kDigestDigits = 12;
  const std::string digest =
      ToHex(ComputeSha256(relative_path)).substr(0, kDigestDigits);
  if (plain.empty() || !IsLower(plain.front())) plain.insert(0, "s-");
  plain.resize(
      std::min(plain.size(), kMaxIdentifierLength - 1 - kDigestDigits));
  while (plain.back() == '-') plain.pop_back();
  return plain + '-' + digest;
}

}  // namespace argmesh
