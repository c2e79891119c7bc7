// A prepared SQLite statement, reset and unbound when it goes out of scope.
//
// Values are only ever bound, never put into SQL text. The first error of a
// chain of binds is kept and told by Step.
#ifndef ARGMESH_SERVER_STORAGE_SQLITE_STATEMENT_H_
#define ARGMESH_SERVER_STORAGE_SQLITE_STATEMENT_H_

#include <sqlite3.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/sha256.h"

namespace argmesh {

// The status of a failed call on `db`; `what` is the statement or the call.
//
// STORE_FULL for SQLITE_FULL, STORED_DATA_DAMAGED for damaged files,
// STORE_UNAVAILABLE for locks, I/O and permissions, INTERNAL for the rest.
absl::Status SqliteError(sqlite3* db, int code, std::string_view what);

// Bytes bound as a BLOB, not as TEXT.
struct SqliteBlob {
  explicit SqliteBlob(std::string_view blob) : bytes(blob) {}
  explicit SqliteBlob(const Sha256Digest& digest);
  std::string_view bytes;
};

class SqliteStatement {
 public:
  enum class AfterUse { kReset, kFinalize };

  // Borrows `statement`, which must outlive this object; kFinalize: takes it.
  SqliteStatement(sqlite3* db, sqlite3_stmt* statement,
                  AfterUse after_use = AfterUse::kReset);
  ~SqliteStatement();
  SqliteStatement(SqliteStatement&& other) noexcept;
  SqliteStatement& operator=(SqliteStatement&&) = delete;

  // The next parameter. Text and blobs must live until the last Step.
  void Bind(int64_t value);
  void Bind(int value) { Bind(int64_t{value}); }
  void Bind(uint32_t value) { Bind(int64_t{value}); }
  void Bind(bool value) { Bind(int64_t{value ? 1 : 0}); }
  void Bind(double value);
  void Bind(std::string_view text);
  void Bind(const char* text) { Bind(std::string_view(text)); }
  void Bind(const std::string& text) { Bind(std::string_view(text)); }
  void Bind(SqliteBlob blob);
  void Bind(std::nullopt_t);
  template <typename T>
  void Bind(const std::optional<T>& value) {
    if (value) {
      Bind(*value);
    } else {
      Bind(std::nullopt);
    }
  }

  // True: a row is there to be read.
  absl::StatusOr<bool> Step();

  // Columns of the present row, from 0.
  int64_t Int(int column) const;
  std::string Text(int column) const;
  std::string Blob(int column) const;
  // STORED_DATA_DAMAGED when it has not 32 bytes.
  absl::StatusOr<Sha256Digest> Digest(int column) const;
  bool IsNull(int column) const;

 private:
  void Check(int code);

  sqlite3* db_;
  sqlite3_stmt* statement_;
  AfterUse after_use_;
  int bound_ = 0;
  int error_ = SQLITE_OK;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_SQLITE_STATEMENT_H_
