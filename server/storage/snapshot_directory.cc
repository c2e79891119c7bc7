#include "server/storage/snapshot_directory.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <thread>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/storage/posix_file.h"
#include "server/storage/schema.h"
#include "server/storage/sealed_archive.h"
#include "server/storage/snapshot_format.h"
#include "server/storage/stopped_queries.h"
#include "server/storage/storage_check.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

constexpr char kUnfinished[] = ".part";
constexpr char kSuffix[] = ".tar";
constexpr char kDigestSuffix[] = ".sha256";
constexpr size_t kDigestDigits = 64;
constexpr std::chrono::milliseconds kBetweenTries(10);

// Removes a file when it goes out of scope; one that is not there is fine.
class Discard {
 public:
  explicit Discard(fs::path path) : path_(std::move(path)) { Remove(); }
  ~Discard() { Remove(); }
  Discard(const Discard&) = delete;
  Discard& operator=(const Discard&) = delete;

 private:
  void Remove() const { ::unlink(path_.c_str()); }
  const fs::path path_;
};

absl::Status NotFound(std::string_view id) {
  return MakeError(ErrorReason::kSnapshotNotFound,
                   absl::StrFormat("there is no snapshot %s", std::string(id)),
                   {{"snapshot", std::string(id)}});
}

absl::StatusOr<int64_t> BytesOf(const fs::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile file, OpenFile(path, O_RDONLY));
  return FileSize(file, path);
}

absl::Status AppendFile(const fs::path& path, const char* member,
                        const StopToken& stop, ArchiveWriter& archive) {
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile file, OpenFile(path, O_RDONLY));
  ARGMESH_ASSIGN_OR_RETURN(const int64_t size, FileSize(file, path));
  ARGMESH_RETURN_IF_ERROR(archive.Begin(member, size));
  for (int64_t position = 0; position < size; position += kPieceBytes) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    ARGMESH_ASSIGN_OR_RETURN(const std::string bytes,
                             ReadAt(file, path, position, kPieceBytes));
    ARGMESH_RETURN_IF_ERROR(archive.Append(bytes));
  }
  return absl::OkStatus();
}

absl::Status WriteDigestFile(const fs::path& path, const std::string& name,
                             const Sha256Digest& sha256) {
  return WriteFile(path, absl::StrCat(ToHex(sha256), "  ", name, "\n"));
}

absl::StatusOr<Sha256Digest> ReadDigestFile(const fs::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile file, OpenFile(path, O_RDONLY));
  ARGMESH_ASSIGN_OR_RETURN(
      const std::string digits,
      ReadAt(file, path, 0, static_cast<int64_t>(kDigestDigits)));
  if (digits.size() != kDigestDigits ||
      digits.find_first_not_of("0123456789abcdef") != std::string::npos) {
    return MakeError(ErrorReason::kStoredDataDamaged,
                     absl::StrFormat("%s holds no digest", path.string()));
  }
  const std::string bytes = absl::HexStringToBytes(digits);
  Sha256Digest sha256;
  std::copy(bytes.begin(), bytes.end(), sha256.begin());
  return sha256;
}

class FileSnapshotReader : public SnapshotReader {
 public:
  FileSnapshotReader(SnapshotRecord record, PosixFile file, fs::path path)
      : record_(std::move(record)),
        file_(std::move(file)),
        path_(std::move(path)) {}

  const SnapshotRecord& record() const override { return record_; }
  absl::StatusOr<std::string> Read(int64_t max_bytes) override {
    ARGMESH_ASSIGN_OR_RETURN(std::string bytes,
                             ReadAt(file_, path_, position_, max_bytes));
    position_ += static_cast<int64_t>(bytes.size());
    return bytes;
  }

 private:
  const SnapshotRecord record_;
  const PosixFile file_;
  const fs::path path_;
  int64_t position_ = 0;
};

}  // namespace

absl::StatusOr<std::unique_ptr<SnapshotDirectory>> SnapshotDirectory::Open(
    std::shared_ptr<DataDirectory> directory, DirectoryMeshStore& meshes) {
  const fs::path folder = directory->snapshots_path();
  std::error_code error;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == kUnfinished) {
      fs::remove(entry.path(), error);
    }
  }
  if (error) return FileError("clean up", folder, error.value());
  return std::unique_ptr<SnapshotDirectory>(
      new SnapshotDirectory(std::move(directory), meshes));
}

fs::path SnapshotDirectory::PathOf(std::string_view id) const {
  return directory_->snapshots_path() / absl::StrCat(std::string(id), kSuffix);
}

absl::StatusOr<std::unique_ptr<SqliteConnection>>
SnapshotDirectory::CopyCatalog(const fs::path& copy,
                               const StopToken& stop) const {
  {
    ARGMESH_ASSIGN_OR_RETURN(
        const std::unique_ptr<SqliteConnection> live,
        SqliteConnection::Open(directory_->database_path(),
                               SqliteConnection::Mode::kReadOnly));
    // The file is opened for reading only; the pragma would keep the copy
    // from being written too.
    ARGMESH_RETURN_IF_ERROR(live->Execute("PRAGMA query_only=OFF"));
    const StoppedQueries queries(*live, stop);
    const std::string name = copy.string();
    ARGMESH_RETURN_IF_ERROR(
        OrStopped(live->Run("VACUUM INTO ?", name).status(), stop));
  }
  ARGMESH_ASSIGN_OR_RETURN(
      std::unique_ptr<SqliteConnection> catalog,
      SqliteConnection::Open(copy, SqliteConnection::Mode::kReadOnly));
  const StoppedQueries queries(*catalog, stop);
  ARGMESH_RETURN_IF_ERROR(OrStopped(CheckDatabase(*catalog), stop));
  return catalog;
}

absl::StatusOr<SnapshotRecord> SnapshotDirectory::CreateSnapshot(
    std::string_view id, const StopToken& stop) {
  std::unique_lock lock(create_mutex_, std::defer_lock);
  while (!lock.try_lock()) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    std::this_thread::sleep_for(kBetweenTries);
  }
  const fs::path path = PathOf(id);
  std::error_code error;
  if (fs::exists(path, error)) {
    return MakeError(ErrorReason::kSnapshotExists,
                     absl::StrFormat("there is a snapshot %s", std::string(id)),
                     {{"snapshot", std::string(id)}});
  }
  // Before the copy: every mesh that the copy names stays until it is read.
  const MeshPin hold = meshes_.HoldRemovals();
  const fs::path copy = path.string() + ".catalog" + kUnfinished;
  const Discard discard(copy);
  ARGMESH_ASSIGN_OR_RETURN(const int64_t catalog_bytes,
                           BytesOf(directory_->database_path()));
  ARGMESH_RETURN_IF_ERROR(directory_->CheckFreeSpace(catalog_bytes));
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<SqliteConnection> catalog,
                           CopyCatalog(copy, stop));
  return Write(id, copy, *catalog, stop);
}

absl::StatusOr<SnapshotRecord> SnapshotDirectory::Write(
    std::string_view id, const fs::path& copy, SqliteConnection& catalog,
    const StopToken& stop) const {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<NamedMesh> meshes,
                           ReadNamedMeshes(catalog, /*collection=*/""));
  ARGMESH_ASSIGN_OR_RETURN(const int64_t catalog_bytes, BytesOf(copy));
  int64_t bytes = catalog_bytes;
  for (const NamedMesh& mesh : meshes) bytes += mesh.size_bytes;
  ARGMESH_ASSIGN_OR_RETURN(SpaceClaim space, directory_->Claim(bytes));

  const fs::path path = PathOf(id);
  const fs::path unfinished = path.string() + kUnfinished;
  const Discard discard(unfinished);
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<ArchiveWriter> archive,
                           ArchiveWriter::Create(unfinished));
  ARGMESH_RETURN_IF_ERROR(archive->Begin(
      kSnapshotVersionMember, static_cast<int64_t>(kSnapshotVersion.size())));
  ARGMESH_RETURN_IF_ERROR(archive->Append(kSnapshotVersion));
  ARGMESH_RETURN_IF_ERROR(
      AppendFile(copy, kSnapshotCatalogMember, stop, *archive));
  space.Wrote(catalog_bytes);
  for (const NamedMesh& mesh : meshes) {
    ARGMESH_RETURN_IF_ERROR(
        archive->Begin(MeshMemberName(mesh.sha256), mesh.size_bytes));
    ARGMESH_RETURN_IF_ERROR(
        ReadWholeMesh(meshes_, mesh, stop, [&](std::string_view piece) {
          space.Wrote(static_cast<int64_t>(piece.size()));
          return archive->Append(piece);
        }));
  }
  ARGMESH_ASSIGN_OR_RETURN(const ArchiveSummary summary, archive->Finish());
  // The digest first: a snapshot is there when its archive is.
  ARGMESH_RETURN_IF_ERROR(WriteDigestFile(path.string() + kDigestSuffix,
                                          path.filename(), summary.sha256));
  if (std::rename(unfinished.c_str(), path.c_str()) != 0) {
    return FileError("rename", path, errno);
  }
  ARGMESH_RETURN_IF_ERROR(SyncDirectory(path.parent_path()));
  return GetSnapshot(id);
}

absl::StatusOr<SnapshotRecord> SnapshotDirectory::GetSnapshot(
    std::string_view id) const {
  const fs::path path = PathOf(id);
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    return errno == ENOENT ? NotFound(id) : FileError("stat", path, errno);
  }
  SnapshotRecord record;
  record.id = std::string(id);
  record.create_time = absl::TimeFromTimespec(status.st_mtim);
  record.size_bytes = status.st_size;
  ARGMESH_ASSIGN_OR_RETURN(record.sha256,
                           ReadDigestFile(path.string() + kDigestSuffix));
  return record;
}

absl::StatusOr<std::vector<SnapshotRecord>> SnapshotDirectory::ListSnapshots()
    const {
  std::vector<std::string> ids;
  std::error_code error;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(directory_->snapshots_path(), error)) {
    const fs::path& path = entry.path();
    if (path.extension() == kSuffix) ids.push_back(path.stem().string());
  }
  if (error) {
    return FileError("list", directory_->snapshots_path(), error.value());
  }
  std::sort(ids.begin(), ids.end());
  std::vector<SnapshotRecord> records;
  for (const std::string& id : ids) {
    absl::StatusOr<SnapshotRecord> record = GetSnapshot(id);
    // One may be deleted while they are listed.
    if (ReasonOf(record.status()) == ErrorReason::kSnapshotNotFound) continue;
    ARGMESH_RETURN_IF_ERROR(record.status());
    records.push_back(*std::move(record));
  }
  return records;
}

absl::StatusOr<std::unique_ptr<SnapshotReader>> SnapshotDirectory::OpenSnapshot(
    std::string_view id) const {
  ARGMESH_ASSIGN_OR_RETURN(SnapshotRecord record, GetSnapshot(id));
  fs::path path = PathOf(id);
  ARGMESH_ASSIGN_OR_RETURN(PosixFile file, OpenFile(path, O_RDONLY));
  return std::unique_ptr<SnapshotReader>(std::make_unique<FileSnapshotReader>(
      std::move(record), std::move(file), std::move(path)));
}

absl::Status SnapshotDirectory::DeleteSnapshot(std::string_view id) {
  const fs::path path = PathOf(id);
  if (::unlink(path.c_str()) != 0) {
    return errno == ENOENT ? NotFound(id) : FileError("unlink", path, errno);
  }
  ::unlink((path.string() + kDigestSuffix).c_str());
  return SyncDirectory(path.parent_path());
}

absl::StatusOr<StorageReport> SnapshotDirectory::Verify(
    std::string_view collection, const StopToken& stop) const {
  const MeshPin hold = meshes_.HoldRemovals();
  ARGMESH_ASSIGN_OR_RETURN(
      const std::unique_ptr<SqliteConnection> connection,
      SqliteConnection::Open(directory_->database_path(),
                             SqliteConnection::Mode::kReadOnly));
  // One state of the catalog throughout.
  ARGMESH_RETURN_IF_ERROR(connection->Execute("BEGIN"));
  absl::StatusOr<StorageReport> report =
      CheckStorage(*connection, meshes_, collection, stop);
  (void)connection->Execute("ROLLBACK");
  return report;
}

}  // namespace argmesh
