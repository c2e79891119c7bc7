#include "server/storage/storage_check.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/crc32c.h"
#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/error_reason.h"
#include "server/storage/catalog_rows.h"
#include "server/storage/posix_file.h"
#include "server/storage/stopped_queries.h"

namespace argmesh {
namespace {

// Holds for the shapes `s` of the collections `c` that are looked at: those of
// the first parameter, all when it is empty.
constexpr char kOfCollection[] =
    "(c.name = ?1 OR (?1 = '' AND c.name < " ARGMESH_DELETED "))";

// Every column of stored bytes, and the column of its CRC-32C.
struct CheckedColumn {
  const char* table;
  const char* bytes;
  const char* crc32c;
  const char* shape;  // from table t to shape s
};
constexpr char kOfShape[] = "JOIN shape s ON s.id = t.shape_id";
constexpr char kOfGraph[] =
    "JOIN graph g ON g.id = t.graph_id JOIN shape s ON s.id = g.shape_id";
constexpr CheckedColumn kColumns[] = {
    {"graph", "arg", "crc32c", kOfShape},
    {"face_label", "labels", "crc32c", kOfGraph},
    {"signature", "bytes", "crc32c", kOfShape},
    {"surface_windows", "words", "words_crc32c", kOfShape},
    {"surface_windows", "windows", "windows_crc32c", kOfShape},
};

void AddFinding(StorageReport& report, std::string finding) {
  ++report.findings;
  if (report.first_findings.size() < kMaxFindings) {
    report.first_findings.push_back(std::move(finding));
  }
}

// The rows of a pragma that says "ok" in one row when all is well.
absl::Status CheckStructure(SqliteConnection& connection, const char* pragma,
                            StorageReport& report) {
  ARGMESH_ASSIGN_OR_RETURN(SqliteStatement rows, connection.Query(pragma));
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const bool row, rows.Step());
    if (!row) return absl::OkStatus();
    const std::string text = rows.Text(0);
    if (text != "ok") AddFinding(report, absl::StrCat(pragma, ": ", text));
  }
}

absl::Status CheckColumn(SqliteConnection& connection,
                         const CheckedColumn& column,
                         std::string_view collection, const StopToken& stop,
                         StorageReport& report) {
  const std::string sql = absl::StrFormat(
      "SELECT c.name, s.name, t.%s, t.%s FROM %s t %s JOIN collection c ON "
      "c.id = s.collection_id WHERE %s ORDER BY t.rowid",
      column.bytes, column.crc32c, column.table, column.shape, kOfCollection);
  ARGMESH_ASSIGN_OR_RETURN(SqliteStatement rows,
                           connection.Query(sql, collection));
  while (true) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    ARGMESH_ASSIGN_OR_RETURN(const bool row, rows.Step());
    if (!row) return absl::OkStatus();
    ++report.checksums;
    if (ComputeCrc32c(rows.Blob(2)) != rows.Int(3)) {
      AddFinding(report,
                 absl::StrFormat(
                     "collections/%s/shapes/%s: %s of table %s fails its "
                     "checksum",
                     rows.Text(0), rows.Text(1), column.bytes, column.table));
    }
  }
}

absl::Status CheckGraphsAreThere(SqliteConnection& connection,
                                 std::string_view collection,
                                 StorageReport& report) {
  ARGMESH_ASSIGN_OR_RETURN(
      report.shapes,
      connection.QueryInt(
          absl::StrCat("SELECT COUNT(*) FROM shape s JOIN collection c ON "
                       "c.id = s.collection_id WHERE ",
                       kOfCollection),
          collection));
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement rows,
      connection.Query(
          absl::StrCat("SELECT c.name, s.name FROM shape s JOIN collection c "
                       "ON c.id = s.collection_id WHERE ",
                       kOfCollection,
                       " AND NOT EXISTS (SELECT 1 FROM graph g WHERE "
                       "g.id = s.graph_id)"),
          collection));
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const bool row, rows.Step());
    if (!row) return absl::OkStatus();
    AddFinding(report, absl::StrFormat("collections/%s/shapes/%s: its graph is "
                                       "missing",
                                       rows.Text(0), rows.Text(1)));
  }
}

absl::Status CheckMeshes(SqliteConnection& connection, const MeshStore& meshes,
                         std::string_view collection, const StopToken& stop,
                         StorageReport& report) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<NamedMesh> named,
                           ReadNamedMeshes(connection, collection));
  for (const NamedMesh& mesh : named) {
    absl::Status status =
        ReadWholeMesh(meshes, mesh, stop, [&report](std::string_view piece) {
          report.mesh_bytes += static_cast<int64_t>(piece.size());
          return absl::OkStatus();
        });
    ++report.meshes;
    if (ReasonOf(status) == ErrorReason::kStoredDataDamaged) {
      AddFinding(report, std::string(status.message()));
    } else if (!status.ok()) {
      return status;
    }
  }
  return absl::OkStatus();
}

absl::Status Check(SqliteConnection& connection, const MeshStore& meshes,
                   std::string_view collection, const StopToken& stop,
                   StorageReport& report) {
  if (collection.empty()) {
    for (const char* pragma :
         {"PRAGMA integrity_check", "PRAGMA foreign_key_check"}) {
      ARGMESH_RETURN_IF_ERROR(CheckStructure(connection, pragma, report));
    }
  } else {
    ARGMESH_ASSIGN_OR_RETURN(
        const int64_t collections,
        connection.QueryInt("SELECT COUNT(*) FROM collection WHERE name = ?",
                            collection));
    if (collections == 0) return CollectionNotFoundError(collection);
  }
  ARGMESH_RETURN_IF_ERROR(CheckGraphsAreThere(connection, collection, report));
  for (const CheckedColumn& column : kColumns) {
    ARGMESH_RETURN_IF_ERROR(
        CheckColumn(connection, column, collection, stop, report));
  }
  return CheckMeshes(connection, meshes, collection, stop, report);
}

}  // namespace

absl::StatusOr<std::vector<NamedMesh>> ReadNamedMeshes(
    SqliteConnection& connection, std::string_view collection) {
  ARGMESH_ASSIGN_OR_RETURN(
      SqliteStatement rows,
      connection.Query(
          absl::StrCat("SELECT sha256, size_bytes FROM mesh WHERE ?1 = '' OR "
                       "sha256 IN (SELECT s.mesh_sha256 FROM shape s JOIN "
                       "collection c ON c.id = s.collection_id WHERE ",
                       kOfCollection, ") ORDER BY sha256"),
          collection));
  std::vector<NamedMesh> named;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const bool row, rows.Step());
    if (!row) return named;
    NamedMesh mesh;
    ARGMESH_ASSIGN_OR_RETURN(mesh.sha256, rows.Digest(0));
    mesh.size_bytes = rows.Int(1);
    named.push_back(mesh);
  }
}

absl::Status ReadWholeMesh(
    const MeshStore& meshes, const NamedMesh& mesh, const StopToken& stop,
    const std::function<absl::Status(std::string_view)>& piece) {
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<MeshReader> reader,
                           meshes.Open(mesh.sha256));
  if (reader->size_bytes() != mesh.size_bytes) {
    return MakeError(ErrorReason::kStoredDataDamaged,
                     absl::StrFormat("mesh %s has %d bytes instead of %d",
                                     ToHex(mesh.sha256), reader->size_bytes(),
                                     mesh.size_bytes),
                     {{"sha256", ToHex(mesh.sha256)}});
  }
  while (true) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    ARGMESH_ASSIGN_OR_RETURN(const std::string bytes,
                             reader->Read(kPieceBytes));
    if (bytes.empty()) return absl::OkStatus();
    ARGMESH_RETURN_IF_ERROR(piece(bytes));
  }
}

absl::StatusOr<StorageReport> CheckStorage(SqliteConnection& connection,
                                           const MeshStore& meshes,
                                           std::string_view collection,
                                           const StopToken& stop) {
  const StoppedQueries queries(connection, stop);
  StorageReport report;
  ARGMESH_RETURN_IF_ERROR(
      OrStopped(Check(connection, meshes, collection, stop, report), stop));
  return report;
}

}  // namespace argmesh
