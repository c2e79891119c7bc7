#include "server/storage/request_memory.h"

#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"

namespace argmesh {

absl::StatusOr<std::optional<std::string>> RecallRequest(
    SqliteConnection& connection, const RequestStamp& request) {
  if (request.request_id.empty()) return std::nullopt;
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement statement,
      connection.Query("SELECT method, request_hash, response "
                       "FROM request_dedup "
                       "WHERE principal = ? AND request_id = ? "
                       "AND expire_us > ?",
                       request.principal, request.request_id,
                       absl::ToUnixMicros(absl::Now())));
  ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
  if (!row) return std::nullopt;
  ARGMESH_ASSIGN_OR_RETURN(const Sha256Digest hash, statement.Digest(1));
  if (statement.Text(0) != request.method || hash != request.hash) {
    return RequestIdReusedError(request.request_id);
  }
  return statement.Blob(2);
}

absl::Status RememberRequest(SqliteConnection& connection,
                             const RequestStamp& request,
                             std::string_view answer) {
  if (request.request_id.empty()) return absl::OkStatus();
  ARGMESH_RETURN_IF_ERROR(
      connection
          .Run("DELETE FROM request_dedup WHERE (principal, request_id) IN "
               "(SELECT principal, request_id FROM request_dedup "
               "WHERE expire_us <= ? LIMIT 16)",
               absl::ToUnixMicros(absl::Now()))
          .status());
  return connection
      .Run(
          "INSERT OR REPLACE INTO request_dedup (principal, request_id, "
          "method, request_hash, response, expire_us) "
          "VALUES (?, ?, ?, ?, ?, ?)",
          request.principal, request.request_id, request.method,
          SqliteBlob(request.hash), SqliteBlob(answer),
          absl::ToUnixMicros(request.expire_time))
      .status();
}

}  // namespace argmesh
