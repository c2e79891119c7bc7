#include "server/storage/snapshot_format.h"

#include <algorithm>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"

namespace argmesh {
namespace {

constexpr std::string_view kFolder = "blobs/";
constexpr size_t kDigits = 64;
constexpr size_t kDigitsBegin = kFolder.size() + 3;  // "ab/"

}  // namespace

std::string MeshMemberName(const Sha256Digest& sha256) {
  const std::string digits = ToHex(sha256);
  return absl::StrCat("blobs/", digits.substr(0, 2), "/", digits);
}

std::optional<Sha256Digest> DigestOfMember(std::string_view name) {
  if (name.size() != kDigitsBegin + kDigits) return std::nullopt;
  const std::string digits(name.substr(kDigitsBegin));
  if (digits.find_first_not_of("0123456789abcdef") != std::string::npos) {
    return std::nullopt;
  }
  Sha256Digest sha256;
  const std::string bytes = absl::HexStringToBytes(digits);
  std::copy(bytes.begin(), bytes.end(), sha256.begin());
  if (name != MeshMemberName(sha256)) return std::nullopt;
  return sha256;
}

}  // namespace argmesh
