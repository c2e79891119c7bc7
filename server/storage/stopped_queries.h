// Statements of SQLite that end when a StopToken says so, even those that work
// within one step: VACUUM, a check of the structure.
#ifndef ARGMESH_SERVER_STORAGE_STOPPED_QUERIES_H_
#define ARGMESH_SERVER_STORAGE_STOPPED_QUERIES_H_

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include "absl/status/status.h"
#include "core/base/stop_token.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

// While it lives, whatever the connection runs is interrupted within about
// 10 ms of the stop. An interrupted statement only says that it was: see
// OrStopped.
class StoppedQueries {
 public:
  // `connection` must outlive it.
  StoppedQueries(SqliteConnection& connection, const StopToken& stop);
  StoppedQueries(const StoppedQueries&) = delete;
  StoppedQueries& operator=(const StoppedQueries&) = delete;

 private:
  void Watch(std::stop_token end);

  sqlite3* const db_;
  const StopToken stop_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread watcher_;  // goes first
};

// `status`, or why `stop` ended what failed.
absl::Status OrStopped(absl::Status status, const StopToken& stop);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_STOPPED_QUERIES_H_
