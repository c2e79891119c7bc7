#include "server/storage/restore.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/storage/posix_file.h"
#include "server/storage/schema.h"
#include "server/storage/sealed_archive.h"
#include "server/storage/snapshot_format.h"
#include "server/storage/storage_check.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

constexpr char kRestoring[] = "restoring";
// In it: the snapshot is whole. Holds the name of the folder for the data that
// was there before.
constexpr char kComplete[] = "complete";
constexpr int64_t kMaxFolderName = 100;

absl::Status Damaged(const fs::path& snapshot, const std::string& what) {
  return MakeError(ErrorReason::kStoredDataDamaged,
                   absl::StrFormat("snapshot %s: %s", snapshot.string(), what));
}

// The member's bytes as a file; its digest.
absl::StatusOr<Sha256Digest> Unpack(ArchiveReader& archive,
                                    const fs::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile file,
                           OpenFile(path, O_WRONLY | O_CREAT | O_EXCL));
  Sha256Hasher hasher;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const std::string bytes,
                             archive.Read(kPieceBytes));
    if (bytes.empty()) break;
    hasher.Update(bytes);
    ARGMESH_RETURN_IF_ERROR(WriteAll(file, path, bytes));
  }
  ARGMESH_RETURN_IF_ERROR(SyncFile(file, path));
  return hasher.Finish();
}

absl::Status CheckVersion(ArchiveReader& archive, const fs::path& snapshot) {
  ArchiveMember member;
  ARGMESH_ASSIGN_OR_RETURN(const bool any, archive.Next(member));
  if (!any || member.name != kSnapshotVersionMember) {
    return absl::FailedPreconditionError(
        absl::StrFormat("%s is no argmesh snapshot", snapshot.string()));
  }
  ARGMESH_ASSIGN_OR_RETURN(const std::string version,
                           archive.Read(kPieceBytes));
  if (version == kSnapshotVersion) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrFormat(
      "%s is of another version of snapshots than this program reads",
      snapshot.string()));
}

// Unpacks every member below `folder`; how many meshes there were.
absl::StatusOr<int64_t> UnpackAll(const fs::path& snapshot,
                                  const fs::path& folder) {
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<ArchiveReader> archive,
                           ArchiveReader::Open(snapshot));
  ARGMESH_RETURN_IF_ERROR(CheckVersion(*archive, snapshot));
  int64_t meshes = 0;
  ArchiveMember member;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const bool more, archive->Next(member));
    if (!more) return meshes;
    const auto sha256 = DigestOfMember(member.name);
    if (!sha256 && member.name != kSnapshotCatalogMember) {
      return Damaged(snapshot, "it holds \"" + member.name + "\"");
    }
    const fs::path path = folder / member.name;
    if (sha256) {
      ARGMESH_RETURN_IF_ERROR(MakeDirectory(path.parent_path()));
      ++meshes;
    }
    ARGMESH_ASSIGN_OR_RETURN(const Sha256Digest digest, Unpack(*archive, path));
    ARGMESH_RETURN_IF_ERROR(SyncDirectory(path.parent_path()));
    if (sha256 && digest != *sha256) {
      return Damaged(snapshot, member.name + " has other bytes");
    }
  }
}

// The database is sound, not newer than this program, and names just the
// meshes that came with it.
absl::Status CheckUnpacked(const fs::path& snapshot, const fs::path& folder,
                           int64_t meshes) {
  const fs::path database = folder / kSnapshotCatalogMember;
  std::error_code error;
  if (!fs::exists(database, error)) {
    return Damaged(snapshot, "it holds no catalog");
  }
  ARGMESH_ASSIGN_OR_RETURN(
      const std::unique_ptr<SqliteConnection> catalog,
      SqliteConnection::Open(database, SqliteConnection::Mode::kReadOnly));
  ARGMESH_ASSIGN_OR_RETURN(const int64_t version,
                           catalog->QueryInt("PRAGMA user_version"));
  if (version > static_cast<int64_t>(CatalogMigrations().size())) {
    return absl::FailedPreconditionError(absl::StrFormat(
        "%s has schema version %d; this program knows versions up to %d",
        snapshot.string(), version, CatalogMigrations().size()));
  }
  ARGMESH_RETURN_IF_ERROR(CheckDatabase(*catalog));
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<NamedMesh> named,
                           ReadNamedMeshes(*catalog, /*collection=*/""));
  for (const NamedMesh& mesh : named) {
    const std::string name = MeshMemberName(mesh.sha256);
    if (static_cast<int64_t>(fs::file_size(folder / name, error)) !=
        mesh.size_bytes) {
      return Damaged(snapshot, name + " is missing or of another size");
    }
  }
  if (static_cast<int64_t>(named.size()) != meshes) {
    return Damaged(snapshot, "it holds meshes that nothing names");
  }
  return absl::OkStatus();
}

absl::Status MarkComplete(const fs::path& folder, const std::string& kept) {
  return ReplaceFile(folder / kComplete, kept + "\n");
}

// Renames `name` of one folder to another; nothing when it is not there.
absl::Status Move(const fs::path& from, const fs::path& to, const char* name) {
  if (std::rename((from / name).c_str(), (to / name).c_str()) != 0 &&
      errno != ENOENT) {
    return FileError("rename", from / name, errno);
  }
  ARGMESH_RETURN_IF_ERROR(SyncDirectory(to));
  return SyncDirectory(from);
}

// Each step may have been done before a crash: `restoring/NAME` is there until
// the new one is in its place, so what lies in the place then is the old one.
absl::Status ChangePlaces(const fs::path& data, const fs::path& restoring,
                          const fs::path& kept) {
  std::error_code error;
  ARGMESH_RETURN_IF_ERROR(MakeDirectory(kept));
  if (fs::exists(restoring / "catalog.db", error)) {
    for (const char* name :
         {"clean", "catalog.db-shm", "catalog.db-wal", "catalog.db"}) {
      ARGMESH_RETURN_IF_ERROR(Move(data, kept, name));
    }
    ARGMESH_RETURN_IF_ERROR(Move(restoring, data, "catalog.db"));
  }
  if (fs::exists(restoring / "blobs", error)) {
    ARGMESH_RETURN_IF_ERROR(Move(data, kept, "blobs"));
    ARGMESH_RETURN_IF_ERROR(Move(restoring, data, "blobs"));
  }
  return absl::OkStatus();
}

absl::Status RemoveFolder(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (error) return FileError("remove", folder, error.value());
  return SyncDirectory(folder.parent_path());
}

}  // namespace

absl::Status FinishRestore(const fs::path& data) {
  const fs::path restoring = data / kRestoring;
  const fs::path complete = restoring / kComplete;
  std::error_code error;
  if (!fs::exists(restoring, error)) return absl::OkStatus();
  if (fs::exists(complete, error)) {
    ARGMESH_ASSIGN_OR_RETURN(const PosixFile file,
                             OpenFile(complete, O_RDONLY));
    ARGMESH_ASSIGN_OR_RETURN(std::string kept,
                             ReadAt(file, complete, 0, kMaxFolderName));
    absl::StripAsciiWhitespace(&kept);
    ARGMESH_RETURN_IF_ERROR(ChangePlaces(data, restoring, data / kept));
  }
  return RemoveFolder(restoring);
}

absl::StatusOr<RestoreReport> RestoreSnapshot(const fs::path& snapshot,
                                              const DataDirectory& directory) {
  RestoreReport report;
  std::error_code error;
  report.bytes = static_cast<int64_t>(fs::file_size(snapshot, error));
  if (error) return FileError("read", snapshot, error.value());
  ARGMESH_RETURN_IF_ERROR(directory.CheckFreeSpace(report.bytes));
  const fs::path& data = directory.path();
  const fs::path restoring = data / kRestoring;
  ARGMESH_RETURN_IF_ERROR(MakeDirectory(restoring));
  ARGMESH_RETURN_IF_ERROR(MakeDirectory(restoring / "blobs"));
  absl::StatusOr<int64_t> meshes = UnpackAll(snapshot, restoring);
  absl::Status status = meshes.status();
  if (status.ok()) status = CheckUnpacked(snapshot, restoring, *meshes);
  if (!status.ok()) {
    status.Update(RemoveFolder(restoring));
    return status;
  }
  report.meshes = *meshes;
  const std::string kept = absl::StrCat(
      "before-restore-",
      absl::FormatTime("%Y%m%d-%H%M%E6S", absl::Now(), absl::UTCTimeZone()));
  ARGMESH_RETURN_IF_ERROR(MarkComplete(restoring, kept));
  ARGMESH_RETURN_IF_ERROR(FinishRestore(data));
  if (fs::exists(data / kept / "catalog.db", error)) report.kept = data / kept;
  return report;
}

}  // namespace argmesh
