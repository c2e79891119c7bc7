#include "server/storage/sqlite_readers.h"

#include <utility>

#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"

namespace argmesh {

SqliteReaders::SqliteReaders(std::filesystem::path path, int max_connections)
    : path_(std::move(path)), max_connections_(max_connections) {}

absl::StatusOr<std::unique_ptr<SqliteConnection>> SqliteReaders::Borrow() {
  {
    std::unique_lock lock(mutex_);
    returned_.wait(lock, [this] {
      return closed_ || !idle_.empty() || lent_ < max_connections_;
    });
    if (closed_) return CatalogClosedError();
    ++lent_;
    if (!idle_.empty()) {
      std::unique_ptr<SqliteConnection> connection = std::move(idle_.back());
      idle_.pop_back();
      return connection;
    }
  }
  auto connection =
      SqliteConnection::Open(path_, SqliteConnection::Mode::kReadOnly);
  if (!connection.ok()) Return(nullptr);
  return connection;
}

void SqliteReaders::Return(std::unique_ptr<SqliteConnection> connection) {
  {
    const std::lock_guard lock(mutex_);
    --lent_;
    if (connection != nullptr) idle_.push_back(std::move(connection));
  }
  returned_.notify_all();
}

absl::Status SqliteReaders::Read(
    const std::function<absl::Status(SqliteConnection&)>& read) {
  ARGMESH_ASSIGN_OR_RETURN(std::unique_ptr<SqliteConnection> connection,
                           Borrow());
  absl::Status status = connection->Execute("BEGIN");
  if (status.ok()) {
    status = read(*connection);
    // Nothing was changed: both ends of a transaction are the same, and a
    // failed end gives the connection up.
    if (!connection->Execute("ROLLBACK").ok()) connection.reset();
  }
  Return(std::move(connection));
  return status;
}

void SqliteReaders::Close() {
  std::unique_lock lock(mutex_);
  closed_ = true;
  returned_.notify_all();
  returned_.wait(lock, [this] { return lent_ == 0; });
  idle_.clear();
}

}  // namespace argmesh
