#include "server/storage/sqlite_statement.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_format.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

ErrorReason ReasonOfCode(int code) {
  switch (code & 0xFF) {
    case SQLITE_FULL:
      return ErrorReason::kStoreFull;
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return ErrorReason::kStoredDataDamaged;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_IOERR:
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_NOMEM:
    case SQLITE_PROTOCOL:
      return ErrorReason::kStoreUnavailable;
    default:
      return ErrorReason::kInternal;
  }
}

std::string BytesOf(const void* data, int size) {
  if (size <= 0) return std::string();
  return std::string(static_cast<const char*>(data), static_cast<size_t>(size));
}

}  // namespace

absl::Status SqliteError(sqlite3* db, int code, std::string_view what) {
  const char* message =
      db == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(db);
  return MakeError(
      ReasonOfCode(code),
      absl::StrFormat("SQLite: %s (%s, code %d) in: %.120s", message,
                      sqlite3_errstr(code), code, std::string(what)));
}

SqliteBlob::SqliteBlob(const Sha256Digest& digest)
    : bytes(static_cast<const char*>(static_cast<const void*>(digest.data())),
            digest.size()) {}

SqliteStatement::SqliteStatement(sqlite3* db, sqlite3_stmt* statement,
                                 AfterUse after_use)
    : db_(db), statement_(statement), after_use_(after_use) {}

SqliteStatement::~SqliteStatement() {
  if (statement_ == nullptr) return;
  if (after_use_ == AfterUse::kFinalize) {
    sqlite3_finalize(statement_);
    return;
  }
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

SqliteStatement::SqliteStatement(SqliteStatement&& other) noexcept
    : db_(other.db_),
      statement_(std::exchange(other.statement_, nullptr)),
      after_use_(other.after_use_),
      bound_(other.bound_),
      error_(other.error_) {}

void SqliteStatement::Check(int code) {
  if (error_ == SQLITE_OK) error_ = code;
}

void SqliteStatement::Bind(int64_t value) {
  Check(sqlite3_bind_int64(statement_, ++bound_, value));
}

void SqliteStatement::Bind(double value) {
  Check(sqlite3_bind_double(statement_, ++bound_, value));
}

// Empty text and blobs are bound with a non-null pointer: null would be NULL.
void SqliteStatement::Bind(std::string_view text) {
  Check(sqlite3_bind_text64(statement_, ++bound_,
                            text.empty() ? "" : text.data(), text.size(),
                            SQLITE_STATIC, SQLITE_UTF8));
}

void SqliteStatement::Bind(SqliteBlob blob) {
  Check(sqlite3_bind_blob64(statement_, ++bound_,
                            blob.bytes.empty() ? "" : blob.bytes.data(),
                            blob.bytes.size(), SQLITE_STATIC));
}

void SqliteStatement::Bind(std::nullopt_t) {
  Check(sqlite3_bind_null(statement_, ++bound_));
}

absl::StatusOr<bool> SqliteStatement::Step() {
  if (error_ != SQLITE_OK) {
    return SqliteError(db_, error_, sqlite3_sql(statement_));
  }
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return SqliteError(db_, code, sqlite3_sql(statement_));
}

int64_t SqliteStatement::Int(int column) const {
  return sqlite3_column_int64(statement_, column);
}

std::string SqliteStatement::Text(int column) const {
  const void* text = sqlite3_column_text(statement_, column);
  return BytesOf(text, sqlite3_column_bytes(statement_, column));
}

std::string SqliteStatement::Blob(int column) const {
  const void* blob = sqlite3_column_blob(statement_, column);
  return BytesOf(blob, sqlite3_column_bytes(statement_, column));
}

absl::StatusOr<Sha256Digest> SqliteStatement::Digest(int column) const {
  const std::string bytes = Blob(column);
  Sha256Digest digest{};
  if (bytes.size() != digest.size()) {
    return MakeError(
        ErrorReason::kStoredDataDamaged,
        absl::StrFormat("a stored SHA-256 has %d bytes, not 32", bytes.size()));
  }
  std::copy(bytes.begin(), bytes.end(), digest.begin());
  return digest;
}

bool SqliteStatement::IsNull(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}

}  // namespace argmesh
