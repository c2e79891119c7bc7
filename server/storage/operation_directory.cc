#include "server/storage/operation_directory.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/sealed_bytes.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/engine/uid.h"
#include "server/storage/posix_file.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

constexpr char kRecordMagic[] = "AOPR";
constexpr uint32_t kVersion = 1;

absl::StatusOr<std::string> ReadSealed(const fs::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(const PosixFile file, OpenFile(path, O_RDONLY));
  ARGMESH_ASSIGN_OR_RETURN(const int64_t size, FileSize(file, path));
  ARGMESH_ASSIGN_OR_RETURN(const std::string bytes,
                           ReadAt(file, path, 0, size));
  const auto payload =
      OpenSealedBytes(path.string(), kRecordMagic, kVersion, bytes);
  if (payload.ok()) return std::string(*payload);
  return MakeError(absl::IsDataLoss(payload.status())
                       ? ErrorReason::kStoredDataDamaged
                       : ErrorReason::kStoreUnavailable,
                   std::string(payload.status().message()));
}

}  // namespace

absl::StatusOr<std::unique_ptr<OperationDirectory>> OperationDirectory::Open(
    std::shared_ptr<const DataDirectory> directory) {
  const fs::path folder = directory->operations_path();
  ARGMESH_RETURN_IF_ERROR(MakeDirectory(folder));
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (it->path().extension() == kUnfinishedSuffix)
      ::unlink(it->path().c_str());
  }
  if (error) return FileError("read", folder, error.value());
  return std::unique_ptr<OperationDirectory>(
      new OperationDirectory(std::move(directory)));
}

absl::Status OperationDirectory::Keep(std::string_view id,
                                      std::string_view bytes) {
  const std::string sealed = SealBytes(kRecordMagic, kVersion, bytes);
  ARGMESH_ASSIGN_OR_RETURN(
      const SpaceClaim space,
      directory_->Claim(static_cast<int64_t>(sealed.size())));
  const std::lock_guard lock(mutex_);
  return ReplaceFile(directory_->operations_path() / id, sealed);
}

absl::Status OperationDirectory::Forget(std::string_view id) {
  const fs::path path = directory_->operations_path() / id;
  const std::lock_guard lock(mutex_);
  if (::unlink(path.c_str()) == 0 || errno == ENOENT) return absl::OkStatus();
  return FileError("remove", path, errno);
}

absl::StatusOr<std::vector<KeptOperation>> OperationDirectory::ReadAll() const {
  const fs::path folder = directory_->operations_path();
  const std::lock_guard lock(mutex_);
  std::vector<KeptOperation> kept;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    const std::string id = it->path().filename().string();
    if (IsUid(id)) kept.push_back({id, ReadSealed(it->path())});
  }
  if (error) return FileError("read", folder, error.value());
  std::sort(kept.begin(), kept.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
  return kept;
}

}  // namespace argmesh
