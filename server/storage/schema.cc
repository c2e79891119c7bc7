#include "server/storage/schema.h"

#include <fcntl.h>

#include <string>
#include <system_error>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/storage/posix_file.h"

namespace argmesh {
namespace {

constexpr char kVersion1[] = R"sql(
CREATE TABLE collection (
  id             INTEGER PRIMARY KEY AUTOINCREMENT,
  name           TEXT    NOT NULL UNIQUE CHECK (length(name) BETWEEN 1 AND 63),
  uid            TEXT    NOT NULL UNIQUE,
  display_name   TEXT    NOT NULL,
  settings       BLOB    NOT NULL,
  graph_version  INTEGER NOT NULL,
  generation     INTEGER NOT NULL DEFAULT 0,
  shape_count    INTEGER NOT NULL DEFAULT 0 CHECK (shape_count >= 0),
  revision       INTEGER NOT NULL DEFAULT 1,
  create_us      INTEGER NOT NULL,
  update_us      INTEGER NOT NULL
) STRICT;

CREATE TABLE mesh (
  sha256         BLOB    NOT NULL PRIMARY KEY CHECK (length(sha256) = 32),
  size_bytes     INTEGER NOT NULL CHECK (size_bytes > 0),
  create_us      INTEGER NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE shape (
  id             INTEGER PRIMARY KEY AUTOINCREMENT,
  collection_id  INTEGER NOT NULL REFERENCES collection(id) ON DELETE RESTRICT,
  name           TEXT    NOT NULL CHECK (length(name) BETWEEN 1 AND 63),
  uid            TEXT    NOT NULL UNIQUE,
  state          INTEGER NOT NULL CHECK (state BETWEEN 1 AND 4),
  error          TEXT    NOT NULL,
  sha256         BLOB    NOT NULL CHECK (length(sha256) = 32),
  size_bytes     INTEGER NOT NULL CHECK (size_bytes > 0),
  format         INTEGER NOT NULL,
  mesh_sha256    BLOB    REFERENCES mesh(sha256) ON DELETE RESTRICT,
  display_name   TEXT    NOT NULL,
  source_uri     TEXT    NOT NULL,
  metadata       TEXT    NOT NULL,
  details        BLOB    NOT NULL,
  generation     INTEGER NOT NULL,
  create_us      INTEGER NOT NULL,
  update_us      INTEGER NOT NULL,
  UNIQUE (collection_id, name)
) STRICT;
CREATE INDEX shape_by_mesh ON shape(mesh_sha256)
  WHERE mesh_sha256 IS NOT NULL;

CREATE TABLE graph (
  shape_id          INTEGER PRIMARY KEY REFERENCES shape(id) ON DELETE CASCADE,
  algorithm_version INTEGER NOT NULL,
  arg               BLOB    NOT NULL,
  crc32c            INTEGER NOT NULL
) STRICT;

CREATE TABLE face_label (
  shape_id       INTEGER PRIMARY KEY REFERENCES shape(id) ON DELETE CASCADE,
  raw_bytes      INTEGER NOT NULL CHECK (raw_bytes >= 0),
  labels         BLOB    NOT NULL,
  crc32c         INTEGER NOT NULL
) STRICT;

CREATE TABLE change_log (
  collection_id  INTEGER NOT NULL REFERENCES collection(id) ON DELETE CASCADE,
  generation     INTEGER NOT NULL,
  name           TEXT    NOT NULL,
  kind           INTEGER NOT NULL CHECK (kind IN (1, 2)),
  PRIMARY KEY (collection_id, generation)
) STRICT, WITHOUT ROWID;

CREATE TABLE request_dedup (
  principal      TEXT    NOT NULL,
  request_id     TEXT    NOT NULL CHECK (length(request_id) = 36),
  method         TEXT    NOT NULL,
  request_hash   BLOB    NOT NULL CHECK (length(request_hash) = 32),
  response       BLOB    NOT NULL,
  expire_us      INTEGER NOT NULL,
  PRIMARY KEY (principal, request_id)
) STRICT, WITHOUT ROWID;
CREATE INDEX request_dedup_expiry ON request_dedup(expire_us);
)sql";

// The words come before the windows: reading them leaves the windows' pages
// alone.
constexpr char kVersion2[] = R"sql(
CREATE TABLE signature (
  shape_id       INTEGER PRIMARY KEY REFERENCES shape(id) ON DELETE CASCADE,
  bytes          BLOB    NOT NULL,
  crc32c         INTEGER NOT NULL
) STRICT;

CREATE TABLE surface_windows (
  shape_id       INTEGER PRIMARY KEY REFERENCES shape(id) ON DELETE CASCADE,
  words          BLOB    NOT NULL,
  words_crc32c   INTEGER NOT NULL,
  windows        BLOB    NOT NULL,
  windows_crc32c INTEGER NOT NULL
) STRICT;
)sql";

// The values of declared keys: TEXT, REAL or INTEGER (0, 1) by the key's type.
constexpr char kVersion3[] = R"sql(
ALTER TABLE collection ADD COLUMN metadata_keys BLOB NOT NULL DEFAULT x'';

CREATE TABLE metadata_value (
  collection_id  INTEGER NOT NULL REFERENCES collection(id) ON DELETE CASCADE,
  key            TEXT    NOT NULL,
  value          ANY     NOT NULL,
  shape_id       INTEGER NOT NULL REFERENCES shape(id) ON DELETE CASCADE,
  PRIMARY KEY (collection_id, key, value, shape_id)
) STRICT, WITHOUT ROWID;
CREATE INDEX metadata_value_by_shape ON metadata_value(shape_id);
)sql";

// A shape may have a second graph, of other settings, until its collection is
// switched to them; `graph_id` says which one counts. Ids are never used again:
// what nothing refers to any more may be removed by its id, later.
constexpr char kVersion4[] = R"sql(
ALTER TABLE graph RENAME TO graph_3;
ALTER TABLE face_label RENAME TO face_label_3;
ALTER TABLE change_log RENAME TO change_log_3;

CREATE TABLE graph (
  id                INTEGER PRIMARY KEY AUTOINCREMENT,
  shape_id          INTEGER NOT NULL REFERENCES shape(id) ON DELETE CASCADE,
  algorithm_version INTEGER NOT NULL,
  arg               BLOB    NOT NULL,
  crc32c            INTEGER NOT NULL
) STRICT;
INSERT INTO graph (id, shape_id, algorithm_version, arg, crc32c)
  SELECT shape_id, shape_id, algorithm_version, arg, crc32c FROM graph_3;
CREATE INDEX graph_by_shape ON graph(shape_id);

CREATE TABLE face_label (
  graph_id       INTEGER PRIMARY KEY REFERENCES graph(id) ON DELETE CASCADE,
  raw_bytes      INTEGER NOT NULL CHECK (raw_bytes >= 0),
  labels         BLOB    NOT NULL,
  crc32c         INTEGER NOT NULL
) STRICT;
INSERT INTO face_label (graph_id, raw_bytes, labels, crc32c)
  SELECT shape_id, raw_bytes, labels, crc32c FROM face_label_3
  WHERE shape_id IN (SELECT id FROM graph);

ALTER TABLE shape ADD COLUMN graph_id INTEGER;
UPDATE shape SET graph_id = id;

CREATE TABLE change_log (
  collection_id  INTEGER NOT NULL REFERENCES collection(id) ON DELETE CASCADE,
  generation     INTEGER NOT NULL,
  name           TEXT    NOT NULL,
  kind           INTEGER NOT NULL CHECK (kind IN (1, 2, 3)),
  PRIMARY KEY (collection_id, generation)
) STRICT, WITHOUT ROWID;
INSERT INTO change_log SELECT collection_id, generation, name, kind
  FROM change_log_3;

DROP TABLE graph_3;
DROP TABLE face_label_3;
DROP TABLE change_log_3;

CREATE TABLE stage (
  collection_id  INTEGER PRIMARY KEY REFERENCES collection(id)
                 ON DELETE CASCADE,
  settings       BLOB    NOT NULL,
  graph_version  INTEGER NOT NULL
) STRICT;

CREATE TABLE staged_shape (
  shape_id       INTEGER PRIMARY KEY REFERENCES shape(id) ON DELETE CASCADE,
  sha256         BLOB    NOT NULL CHECK (length(sha256) = 32),
  graph_id       INTEGER NOT NULL REFERENCES graph(id) ON DELETE CASCADE,
  details        BLOB    NOT NULL
) STRICT;
CREATE INDEX staged_shape_by_graph ON staged_shape(graph_id);
)sql";

constexpr const char* kMigrations[] = {kVersion1, kVersion2, kVersion3,
                                       kVersion4};

// A copy of the database as it is before the first step.
absl::Status CopyBefore(SqliteConnection& connection,
                        const std::filesystem::path& database,
                        int64_t version) {
  std::filesystem::path copy = database;
  copy += absl::StrFormat(".version-%d", version);
  std::error_code ignored;  // one of an interrupted migration
  std::filesystem::remove(copy, ignored);
  const std::string name = copy.string();
  ARGMESH_RETURN_IF_ERROR(connection.Run("VACUUM INTO ?", name).status());
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile file, OpenFile(copy, O_RDONLY));
  return SyncFile(file, copy);
}

absl::Status RunMigration(SqliteConnection& connection, const char* sql,
                          int64_t version) {
  ARGMESH_RETURN_IF_ERROR(connection.Execute("BEGIN IMMEDIATE"));
  absl::Status status = connection.Execute(sql);
  if (status.ok()) {
    // A pragma takes no parameters; the number is our own.
    status = connection.Execute(
        absl::StrFormat("PRAGMA user_version=%d; COMMIT", version));
  }
  if (!status.ok() && connection.in_transaction()) {
    (void)connection.Execute("ROLLBACK");
  }
  return status;
}

absl::StatusOr<std::string> FirstFinding(SqliteConnection& connection,
                                         const char* pragma) {
  ARGMESH_ASSIGN_OR_RETURN(SqliteStatement statement, connection.Query(pragma));
  ARGMESH_ASSIGN_OR_RETURN(const bool row, statement.Step());
  return row ? statement.Text(0) : std::string();
}

}  // namespace

std::span<const char* const> CatalogMigrations() { return kMigrations; }

absl::Status Migrate(SqliteConnection& connection,
                     const std::filesystem::path& database,
                     std::span<const char* const> migrations) {
  const auto known = static_cast<int64_t>(migrations.size());
  ARGMESH_ASSIGN_OR_RETURN(const int64_t application,
                           connection.QueryInt("PRAGMA application_id"));
  ARGMESH_ASSIGN_OR_RETURN(const int64_t version,
                           connection.QueryInt("PRAGMA user_version"));
  ARGMESH_ASSIGN_OR_RETURN(
      const int64_t tables,
      connection.QueryInt("SELECT COUNT(*) FROM sqlite_schema"));
  if (application != kApplicationId && (application != 0 || tables != 0)) {
    return absl::FailedPreconditionError(
        absl::StrFormat("%s is no argmesh database (application_id %#x)",
                        database.string(), application));
  }
  if (version > known) {
    return absl::FailedPreconditionError(absl::StrFormat(
        "%s has schema version %d; this program knows versions up to %d: use "
        "a newer one",
        database.string(), version, known));
  }
  if (version == known) return absl::OkStatus();
  if (version > 0) {
    ARGMESH_RETURN_IF_ERROR(CopyBefore(connection, database, version));
  }
  ARGMESH_RETURN_IF_ERROR(connection.Execute(
      absl::StrFormat("PRAGMA application_id=%d", kApplicationId)));
  for (int64_t step = version; step < known; ++step) {
    ARGMESH_RETURN_IF_ERROR(RunMigration(
        connection, migrations[static_cast<size_t>(step)], step + 1));
  }
  return absl::OkStatus();
}

absl::Status CheckDatabase(SqliteConnection& connection) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string quick,
                           FirstFinding(connection, "PRAGMA quick_check(1)"));
  if (quick != "ok") {
    return MakeError(ErrorReason::kStoredDataDamaged,
                     "the database is damaged: " + quick);
  }
  ARGMESH_ASSIGN_OR_RETURN(
      const std::string broken,
      FirstFinding(connection, "PRAGMA foreign_key_check"));
  if (!broken.empty()) {
    return MakeError(ErrorReason::kStoredDataDamaged,
                     "the database is damaged: rows of table " + broken +
                         " refer to rows that are not there");
  }
  return absl::OkStatus();
}

}  // namespace argmesh
