// The log of what happens to a collection, and its generations.
#ifndef ARGMESH_SERVER_STORAGE_CHANGE_LOG_H_
#define ARGMESH_SERVER_STORAGE_CHANGE_LOG_H_

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/engine/catalog_requests.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

// Changes that are removed in one write, so that others need not wait long.
inline constexpr int64_t kChangesForgottenAtOnce = 1000;

// The collection's next generation, with the change in its log; `added` shapes
// are more in it then.
absl::StatusOr<int64_t> LogChange(SqliteConnection& connection,
                                  int64_t collection, const std::string& id,
                                  ShapeChange::Kind kind, int added);

// Once, when the writing connection is opened: the generations that there are.
absl::Status NoteOpening(SqliteConnection& connection);
// Removes some of the changes up to these; false when none is left.
absl::StatusOr<bool> ForgetSomeChanges(SqliteConnection& connection);
// The same, of all changes of a collection.
absl::StatusOr<bool> ForgetSomeChanges(SqliteConnection& connection,
                                       int64_t collection);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_CHANGE_LOG_H_
