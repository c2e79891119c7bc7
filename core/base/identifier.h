// Resource ids: `^[a-z]([a-z0-9-]{0,61}[a-z0-9])?$` (AIP-122).
#ifndef ARGMESH_CORE_BASE_IDENTIFIER_H_
#define ARGMESH_CORE_BASE_IDENTIFIER_H_

#include <string>
#include <string_view>

#include "absl/status/status.h"

namespace argmesh {

inline constexpr size_t kMaxIdentifierLength = 63;

bool IsIdentifier(std::string_view id);

// kInvalidArgument naming `what`, the id and the rule when it is not one.
absl::Status CheckIdentifier(std::string_view what, std::string_view id);

// A readable id made from a path relative to its folder: lower case, other
// characters turned into '-', followed by '-' and 12 hexadecimal digits of the
// path's SHA-256 whenever the plain form would not give the path back
// ("Cup/21.OFF" and "cup-21.off" get different ids). "cup-21-off" needs none.
std::string IdentifierFromPath(std::string_view relative_path);

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_IDENTIFIER_H_
