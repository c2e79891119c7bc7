// API keys: who may do what, and in which collections.
//
// A key's text is ID.SECRET; SECRET is 256 random bits. Only the SHA-256 of the
// secret is kept: enough for a secret that cannot be guessed, and of no use to
// whoever reads it.
#ifndef ARGMESH_CORE_ACCESS_API_KEY_H_
#define ARGMESH_CORE_ACCESS_API_KEY_H_

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/sha256.h"

namespace argmesh {

// Each may do what those before it may.
enum class AccessRole { kRead, kWrite, kAdmin };

// "read", "write", "admin".
std::string_view AccessRoleName(AccessRole role);
// kInvalidArgument for any other word.
absl::StatusOr<AccessRole> ParseAccessRole(std::string_view name);

// What the holder of a key may use; 0: as much as the server has.
struct KeyLimits {
  double requests_per_second = 0;  // on the average
  int burst = 0;                   // at once after a rest; >= 1 with a rate
  int concurrent_calls = 0;

  bool any() const { return requests_per_second > 0 || concurrent_calls > 0; }
  friend bool operator==(const KeyLimits&, const KeyLimits&) = default;
};

inline constexpr double kMaxKeyRate = 1e6;
inline constexpr int kMaxKeyCalls = 1'000'000;  // burst, concurrent_calls

// kInvalidArgument naming the limit that is out of its range.
absl::Status CheckKeyLimits(const KeyLimits& limits);

struct ApiKey {
  std::string id;  // as a collection's
  Sha256Digest secret_sha256{};
  AccessRole role = AccessRole::kRead;
  std::vector<std::string> collections;  // ids; empty: all
  KeyLimits limits;
  absl::Time create_time;
  absl::Time expire_time = absl::InfiniteFuture();  // infinite: never
};

// What a caller presents.
struct PresentedKey {
  std::string id;
  Sha256Digest secret_sha256{};
};

// A new secret, 43 characters of base64url, from the kernel's generator.
std::string MakeKeySecret();
// "ID.SECRET".
std::string KeyText(std::string_view id, std::string_view secret);
Sha256Digest HashKeySecret(std::string_view secret);

// Takes a key's text apart. kInvalidArgument without quoting it: it may be
// most of a secret.
absl::StatusOr<PresentedKey> ParseKeyText(std::string_view text);

// Whether the digests are equal, in time that does not depend on where they
// differ.
bool SameSecret(const Sha256Digest& a, const Sha256Digest& b);

}  // namespace argmesh

#endif  // ARGMESH_CORE_ACCESS_API_KEY_H_
