// The file that holds API keys: JSON, written by `argmesh keys`, read by the
// server at its start and on SIGHUP.
//
//   {"keys": [{"id": "ci", "sha256": "<64 hexadecimal digits>",
//              "role": "write", "collections": ["parts"],
//              "requests_per_second": 20, "burst": 40, "concurrent_calls": 4,
//              "create_time": "2026-01-31T00:00:00+00:00",
//              "expire_time": "2027-01-31T00:00:00+00:00"}]}
//
// `collections` may be missing (all of them), `expire_time` too (never), and
// the limits (none).
#ifndef ARGMESH_CORE_ACCESS_KEY_FILE_H_
#define ARGMESH_CORE_ACCESS_KEY_FILE_H_

#include <map>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/access/api_key.h"

namespace argmesh {

// At most so many keys, and bytes of the file.
inline constexpr size_t kMaxKeys = 10'000;
inline constexpr size_t kMaxKeyFileBytes = 8 << 20;

// By id.
using KeyRing = std::map<std::string, ApiKey, std::less<>>;

// kInvalidArgument naming the key and what is wrong with it. An unknown field
// is an error: a misspelt `expire_time` must not make a key that never ends.
absl::StatusOr<KeyRing> ParseKeys(std::string_view json);
std::string FormatKeys(const KeyRing& keys);

// kNotFound when there is no file, kFailedPrecondition when others than its
// owner may write to it, else as ParseKeys.
absl::StatusOr<KeyRing> ReadKeyFile(const std::string& path);
// Whole or not at all; readable by the owner only when it is new, with the
// permissions it had otherwise.
absl::Status WriteKeyFile(const std::string& path, const KeyRing& keys);

}  // namespace argmesh

#endif  // ARGMESH_CORE_ACCESS_KEY_FILE_H_
