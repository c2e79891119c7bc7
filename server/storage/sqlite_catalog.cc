#include "server/storage/sqlite_catalog.h"

#include <system_error>
#include <utility>

#include "core/base/status_macros.h"
#include "server/storage/catalog_rows.h"
#include "server/storage/change_log.h"
#include "server/storage/schema.h"
#include "server/storage/stopped_queries.h"

namespace argmesh {
namespace {

constexpr int64_t kForgottenBytes = 64 << 10;  // about what one write changes

absl::Status Prepare(SqliteConnection& connection,
                     const std::filesystem::path& path, bool check,
                     const StopToken& stop) {
  const StoppedQueries queries(connection, stop);
  ARGMESH_RETURN_IF_ERROR(Migrate(connection, path, CatalogMigrations()));
  return check ? CheckDatabase(connection) : absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::unique_ptr<SqliteCatalog>> SqliteCatalog::Open(
    std::shared_ptr<DataDirectory> directory,
    const SqliteCatalogOptions& options, const StopToken& stop) {
  const std::filesystem::path path = directory->database_path();
  std::error_code error;
  const bool existed = std::filesystem::exists(path, error);
  const bool clean = directory->IsMarkedClean();
  ARGMESH_RETURN_IF_ERROR(directory->ClearCleanMark());
  ARGMESH_ASSIGN_OR_RETURN(
      std::unique_ptr<SqliteConnection> connection,
      SqliteConnection::Open(path, SqliteConnection::Mode::kReadWrite));
  ARGMESH_RETURN_IF_ERROR(
      OrStopped(Prepare(*connection, path, existed && !clean, stop), stop));
  ARGMESH_RETURN_IF_ERROR(NoteOpening(*connection));
  ARGMESH_RETURN_IF_ERROR(SyncDirectory(directory->path()));
  return std::unique_ptr<SqliteCatalog>(
      new SqliteCatalog(std::move(directory), std::move(connection), options));
}

SqliteCatalog::SqliteCatalog(std::shared_ptr<DataDirectory> directory,
                             std::unique_ptr<SqliteConnection> connection,
                             const SqliteCatalogOptions& options)
    : directory_(std::move(directory)),
      removed_at_once_(options.removed_at_once),
      writer_(std::move(connection), options.writer),
      readers_(directory_->database_path(), options.max_readers) {}

absl::StatusOr<SpaceClaim> SqliteCatalog::ClaimSpace(int64_t bytes) const {
  absl::StatusOr<SpaceClaim> space = directory_->Claim(bytes);
  if (space.ok()) return space;
  int64_t reusable = 0;
  ARGMESH_RETURN_IF_ERROR(
      readers_.Read([&](SqliteConnection& connection) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(const int64_t pages,
                                 connection.QueryInt("PRAGMA freelist_count"));
        ARGMESH_ASSIGN_OR_RETURN(const int64_t page_bytes,
                                 connection.QueryInt("PRAGMA page_size"));
        reusable = pages * page_bytes;
        return absl::OkStatus();
      }));
  return directory_->Claim(bytes, reusable);
}

StoreLoad SqliteCatalog::Load() const {
  const SqliteWriterLoad writer = writer_.Load();
  StoreLoad load;
  load.wal_bytes = writer.wal_bytes;
  load.queued_writes = writer.queued;
  load.commits = writer.commits;
  load.changes = writer.changes;
  load.commit_seconds = absl::ToDoubleSeconds(writer.commit_time);
  load.free_bytes = directory_->FreeBytes().value_or(0);
  load.writable = directory_->CheckFreeSpace(0).ok();
  (void)readers_.Read([&load](SqliteConnection& connection) -> absl::Status {
    ARGMESH_ASSIGN_OR_RETURN(const int64_t pages,
                             connection.QueryInt("PRAGMA page_count"));
    ARGMESH_ASSIGN_OR_RETURN(const int64_t page_bytes,
                             connection.QueryInt("PRAGMA page_size"));
    load.database_bytes = pages * page_bytes;
    ARGMESH_ASSIGN_OR_RETURN(
        SqliteStatement meshes,
        connection.Query("SELECT COUNT(*), COALESCE(SUM(size_bytes), 0) "
                         "FROM mesh"));
    ARGMESH_RETURN_IF_ERROR(meshes.Step().status());
    load.meshes = meshes.Int(0);
    load.mesh_bytes = meshes.Int(1);
    ARGMESH_ASSIGN_OR_RETURN(
        load.deleted_shapes,
        connection.QueryInt("SELECT COALESCE(SUM(shape_count), 0) "
                            "FROM collection WHERE name >= " ARGMESH_DELETED));
    return absl::OkStatus();
  });
  return load;
}

absl::Status SqliteCatalog::ForgetChanges(const StopToken& stop) {
  bool more = true;
  while (more) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    ARGMESH_RETURN_IF_ERROR(writer_.Write(
        kForgottenBytes, [&more](SqliteConnection& connection) -> absl::Status {
          ARGMESH_ASSIGN_OR_RETURN(more, ForgetSomeChanges(connection));
          return absl::OkStatus();
        }));
  }
  return absl::OkStatus();
}

SqliteCatalog::~SqliteCatalog() { (void)SqliteCatalog::Close(); }

absl::Status SqliteCatalog::Close() {
  const std::lock_guard lock(close_mutex_);
  if (closed_) return absl::OkStatus();
  closed_ = true;
  readers_.Close();  // first: a reader would keep the log from truncation
  ARGMESH_RETURN_IF_ERROR(writer_.Close());
  return directory_->MarkClean();
}

}  // namespace argmesh
