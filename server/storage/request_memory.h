// Remembered requests: the table request_dedup.
#ifndef ARGMESH_SERVER_STORAGE_REQUEST_MEMORY_H_
#define ARGMESH_SERVER_STORAGE_REQUEST_MEMORY_H_

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/status_macros.h"
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

// What `write` answers, remembered with it; for a request that was made before,
// the answer that is remembered.
template <typename Answer, typename Write>
absl::StatusOr<Answer> WriteOnce(
    SqliteConnection& connection, const RequestStamp& request,
    absl::StatusOr<Answer> (*parse)(std::string_view),
    std::string (*serialize)(const Answer&), const Write& write) {
  ARGMESH_ASSIGN_OR_RETURN(const std::optional<std::string> answer,
                           RecallRequest(connection, request));
  if (answer) return parse(*answer);
  ARGMESH_ASSIGN_OR_RETURN(Answer written, write());
  ARGMESH_RETURN_IF_ERROR(
      RememberRequest(connection, request, serialize(written)));
  return written;
}

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_REQUEST_MEMORY_H_
