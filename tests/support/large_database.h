// A database that takes a while to copy or to check.
#ifndef ARGMESH_TESTS_SUPPORT_LARGE_DATABASE_H_
#define ARGMESH_TESTS_SUPPORT_LARGE_DATABASE_H_

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <memory>

#include "absl/status/status.h"
#include "core/base/status_macros.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

// Adds a table of no meaning to the catalog at `database`, which nobody uses;
// a million rows take about 0.1 s to copy and to check, and 1 s to make.
inline absl::Status MakeLarge(const std::filesystem::path& database,
                              int64_t rows = 2'000'000) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::unique_ptr<SqliteConnection> connection,
      SqliteConnection::Open(database, SqliteConnection::Mode::kReadWrite));
  ARGMESH_RETURN_IF_ERROR(connection->Execute(
      "PRAGMA synchronous=OFF;"
      "CREATE TABLE filler (number INTEGER PRIMARY KEY, text TEXT)"));
  return connection
      ->Run(
          "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n "
          "WHERE i < ?) INSERT INTO filler SELECT i, 'of no use' FROM n",
          rows)
      .status();
}

// Time on a CPU that this thread has had, which other work has no part in.
inline double ThreadSeconds() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) +
         1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_LARGE_DATABASE_H_
