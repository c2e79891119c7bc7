// One connection to the catalog's database, with its prepared statements.
//
// Exactly one connection of a process writes and checkpoints; all others are
// read-only: SQLite before 3.51.3 can damage a database that two connections
// write or checkpoint at the same time. No memory mapping.
//
// A connection belongs to one thread at a time.
#ifndef ARGMESH_SERVER_STORAGE_SQLITE_CONNECTION_H_
#define ARGMESH_SERVER_STORAGE_SQLITE_CONNECTION_H_

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/status_macros.h"
#include "server/storage/sqlite_statement.h"

namespace argmesh {

class SqliteConnection {
 public:
  enum class Mode { kReadWrite, kReadOnly };

  // kReadWrite creates the file. Sets every pragma (docs/formats.md).
  static absl::StatusOr<std::unique_ptr<SqliteConnection>> Open(
      const std::filesystem::path& path, Mode mode);
  ~SqliteConnection();
  SqliteConnection(const SqliteConnection&) = delete;
  SqliteConnection& operator=(const SqliteConnection&) = delete;

  // Statements without parameters or rows, one after the other.
  absl::Status Execute(const std::string& sql);

  // The statement with `values` bound, not stepped yet. Prepared once for each
  // text, so only one of a text may be alive at a time.
  template <typename... Values>
  absl::StatusOr<SqliteStatement> Query(std::string_view sql,
                                        const Values&... values) {
    ARGMESH_ASSIGN_OR_RETURN(sqlite3_stmt * prepared, Prepare(sql));
    SqliteStatement statement(db_, prepared);
    (statement.Bind(values), ...);
    return statement;
  }

  // A statement of a text that hardly comes again: not kept, nothing bound.
  absl::StatusOr<SqliteStatement> QueryOnce(std::string_view sql);

  // Runs a statement to its end; how many rows it changed.
  template <typename... Values>
  absl::StatusOr<int64_t> Run(std::string_view sql, const Values&... values) {
    ARGMESH_ASSIGN_OR_RETURN(SqliteStatement statement, Query(sql, values...));
    bool row = true;
    while (row) {
      ARGMESH_ASSIGN_OR_RETURN(row, statement.Step());
    }
    return sqlite3_changes64(db_);
  }

  // First column of the first row; kNotFound when there is none.
  template <typename... Values>
  absl::StatusOr<int64_t> QueryInt(std::string_view sql,
                                   const Values&... values) {
    ARGMESH_ASSIGN_OR_RETURN(SqliteStatement statement, Query(sql, values...));
    ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
    if (!row) return absl::NotFoundError("no row");
    return statement.Int(0);
  }

  int64_t last_insert_id() const { return sqlite3_last_insert_rowid(db_); }
  bool in_transaction() const { return sqlite3_get_autocommit(db_) == 0; }
  sqlite3* handle() { return db_; }

 private:
  explicit SqliteConnection(sqlite3* db) : db_(db) {}
  absl::StatusOr<sqlite3_stmt*> Prepare(std::string_view sql);
  absl::StatusOr<sqlite3_stmt*> Compile(std::string_view sql, unsigned flags);

  sqlite3* db_;
  std::map<std::string, sqlite3_stmt*, std::less<>> statements_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_SQLITE_CONNECTION_H_
