// Read-only connections, lent to one thread at a time.
//
// Each read sees one state of the database, that of its begin. Connections are
// made when needed, up to `max_connections`; then a read waits for one.
#ifndef ARGMESH_SERVER_STORAGE_SQLITE_READERS_H_
#define ARGMESH_SERVER_STORAGE_SQLITE_READERS_H_

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

class SqliteReaders {
 public:
  SqliteReaders(std::filesystem::path path, int max_connections);

  // Runs `read` in a read transaction. Fails as `read` does, DRAINING after
  // Close, else as SqliteError.
  absl::Status Read(const std::function<absl::Status(SqliteConnection&)>& read);

  // Waits for the reads that run and closes all connections. Idempotent.
  void Close();

 private:
  absl::StatusOr<std::unique_ptr<SqliteConnection>> Borrow();
  void Return(std::unique_ptr<SqliteConnection> connection);

  const std::filesystem::path path_;
  const int max_connections_;
  std::mutex mutex_;
  std::condition_variable returned_;
  std::vector<std::unique_ptr<SqliteConnection>> idle_;
  int lent_ = 0;
  bool closed_ = false;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_SQLITE_READERS_H_
