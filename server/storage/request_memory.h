// Remembered requests: the table request_dedup.
#ifndef ARGMESH_SERVER_STORAGE_REQUEST_MEMORY_H_
#define ARGMESH_SERVER_STORAGE_REQUEST_MEMORY_H_

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/engine/catalog_requests.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

// The remembered answer; none for a request that was not made, has expired or
// has no id. REQUEST_ID_REUSED when the id was another request's.
absl::StatusOr<std::optional<std::string>> RecallRequest(
    SqliteConnection& connection, const RequestStamp& request);

// Remembers the answer, and forgets a few of those that have expired.
absl::Status RememberRequest(SqliteConnection& connection,
                             const RequestStamp& request,
                             std::string_view answer);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_REQUEST_MEMORY_H_
