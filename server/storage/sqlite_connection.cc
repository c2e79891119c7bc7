#include "server/storage/sqlite_connection.h"

namespace argmesh {
namespace {

constexpr char kEveryPragmas[] =
    "PRAGMA busy_timeout=5000;"
    "PRAGMA foreign_keys=ON;"
    "PRAGMA trusted_schema=OFF;"
    "PRAGMA cell_size_check=ON;"
    "PRAGMA mmap_size=0;"
    "PRAGMA temp_store=MEMORY;";

// The caches are small: the system caches the file, once for all connections,
// and a page that is not here costs microseconds, while a write waits
// milliseconds for the disk. What does not fit of a large write goes to the
// write-ahead log early. So the memory of a server with all its readers at work
// stays within 12 MiB, however large the database.
//
// page_size only acts on a new file, before journal_mode.
constexpr char kWriterPragmas[] =
    "PRAGMA page_size=8192;"
    "PRAGMA journal_mode=WAL;"
    "PRAGMA synchronous=FULL;"
    "PRAGMA wal_autocheckpoint=0;"
    "PRAGMA journal_size_limit=67108864;"
    "PRAGMA secure_delete=FAST;"
    "PRAGMA cache_size=-4096;";

constexpr char kReaderPragmas[] =
    "PRAGMA query_only=ON;"
    "PRAGMA cache_size=-1024;";

}  // namespace

absl::StatusOr<std::unique_ptr<SqliteConnection>> SqliteConnection::Open(
    const std::filesystem::path& path, Mode mode) {
  const int flags = mode == Mode::kReadWrite
                        ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE
                        : SQLITE_OPEN_READONLY;
  sqlite3* db = nullptr;
  const int code = sqlite3_open_v2(
      path.c_str(), &db, flags | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE,
      nullptr);
  std::unique_ptr<SqliteConnection> connection(new SqliteConnection(db));
  if (code != SQLITE_OK) {
    return SqliteError(db, code, "open " + path.string());
  }
  ARGMESH_RETURN_IF_ERROR(connection->Execute(kEveryPragmas));
  ARGMESH_RETURN_IF_ERROR(connection->Execute(
      mode == Mode::kReadWrite ? kWriterPragmas : kReaderPragmas));
  return connection;
}

SqliteConnection::~SqliteConnection() {
  for (const auto& [sql, statement] : statements_) sqlite3_finalize(statement);
  sqlite3_close(db_);
}

absl::Status SqliteConnection::Execute(const std::string& sql) {
  const int code = sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr);
  if (code == SQLITE_OK) return absl::OkStatus();
  return SqliteError(db_, code, sql);
}

absl::StatusOr<sqlite3_stmt*> SqliteConnection::Prepare(std::string_view sql) {
  if (const auto it = statements_.find(sql); it != statements_.end()) {
    return it->second;
  }
  ARGMESH_ASSIGN_OR_RETURN(sqlite3_stmt * statement,
                           Compile(sql, SQLITE_PREPARE_PERSISTENT));
  statements_.emplace(sql, statement);
  return statement;
}

absl::StatusOr<sqlite3_stmt*> SqliteConnection::Compile(std::string_view sql,
                                                        unsigned flags) {
  sqlite3_stmt* statement = nullptr;
  const int code =
      sqlite3_prepare_v3(db_, sql.data(), static_cast<int>(sql.size()), flags,
                         &statement, nullptr);
  if (code != SQLITE_OK) return SqliteError(db_, code, sql);
  return statement;
}

absl::StatusOr<SqliteStatement> SqliteConnection::QueryOnce(
    std::string_view sql) {
  ARGMESH_ASSIGN_OR_RETURN(sqlite3_stmt * statement, Compile(sql, 0));
  return SqliteStatement(db_, statement, SqliteStatement::AfterUse::kFinalize);
}

}  // namespace argmesh
