#include "core/access/api_key.h"

#include <sys/random.h>

#include <array>
#include <cstdlib>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/identifier.h"

namespace argmesh {
namespace {

constexpr size_t kSecretBytes = 32;
constexpr size_t kSecretDigits = 43;  // base64url without padding

constexpr std::pair<AccessRole, std::string_view> kRoles[] = {
    {AccessRole::kRead, "read"},
    {AccessRole::kWrite, "write"},
    {AccessRole::kAdmin, "admin"},
};

}  // namespace

std::string_view AccessRoleName(AccessRole role) {
  return kRoles[static_cast<size_t>(role)].second;
}

absl::StatusOr<AccessRole> ParseAccessRole(std::string_view name) {
  for (const auto& [role, text] : kRoles) {
    if (text == name) return role;
  }
  return absl::InvalidArgumentError(absl::StrFormat(
      "role '%s' is not one of read, write, admin", std::string(name)));
}

absl::Status CheckKeyLimits(const KeyLimits& limits) {
  const double rate = limits.requests_per_second;
  if (!(rate >= 0 && rate <= kMaxKeyRate)) {  // not NaN
    return absl::InvalidArgumentError(absl::StrFormat(
        "requests_per_second %g is not 0 .. %g", rate, kMaxKeyRate));
  }
  if (limits.burst < (rate > 0 ? 1 : 0) || limits.burst > kMaxKeyCalls) {
    return absl::InvalidArgumentError(
        absl::StrFormat("burst %d is not 1 .. %d", limits.burst, kMaxKeyCalls));
  }
  if (limits.concurrent_calls < 0 || limits.concurrent_calls > kMaxKeyCalls) {
    return absl::InvalidArgumentError(
        absl::StrFormat("concurrent_calls %d is not 0 .. %d",
                        limits.concurrent_calls, kMaxKeyCalls));
  }
  return absl::OkStatus();
}

std::string MakeKeySecret() {
  std::array<char, kSecretBytes> bytes;
  // At most 256 bytes are given at once and whole (getrandom(2)); without the
  // kernel's generator there are no keys.
  if (::getrandom(bytes.data(), bytes.size(), 0) !=
      static_cast<ssize_t>(bytes.size())) {
    std::abort();
  }
  return absl::WebSafeBase64Escape(
      absl::string_view(bytes.data(), bytes.size()));
}

std::string KeyText(std::string_view id, std::string_view secret) {
  return absl::StrCat(std::string(id), ".", std::string(secret));
}

Sha256Digest HashKeySecret(std::string_view secret) {
  return ComputeSha256(secret);
}

absl::StatusOr<PresentedKey> ParseKeyText(std::string_view text) {
  const size_t dot = text.find('.');
  if (dot == std::string_view::npos || text.size() - dot - 1 != kSecretDigits ||
      !IsIdentifier(text.substr(0, dot))) {
    return absl::InvalidArgumentError("the key is not ID.SECRET");
  }
  return PresentedKey{std::string(text.substr(0, dot)),
                      HashKeySecret(text.substr(dot + 1))};
}

bool SameSecret(const Sha256Digest& a, const Sha256Digest& b) {
  unsigned different = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    different |= static_cast<unsigned>(a[i]) ^ static_cast<unsigned>(b[i]);
  }
  return different == 0;
}

}  // namespace argmesh
