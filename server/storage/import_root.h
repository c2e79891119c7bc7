// A folder whose mesh files may be imported, and nothing outside it: every
// path is resolved by openat2 with RESOLVE_BENEATH and RESOLVE_NO_SYMLINKS.
#ifndef ARGMESH_SERVER_STORAGE_IMPORT_ROOT_H_
#define ARGMESH_SERVER_STORAGE_IMPORT_ROOT_H_

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "server/engine/import_source.h"
#include "server/storage/posix_file.h"

namespace argmesh {

class ImportRoot final : public ImportSource {
 public:
  // kStoreUnavailable when there is no such folder.
  static absl::StatusOr<std::unique_ptr<ImportRoot>> Open(
      const std::filesystem::path& root);

  absl::StatusOr<std::vector<std::string>> ListFiles(
      const std::string& folder, const StopToken& stop) const override;
  absl::StatusOr<std::string> Read(const std::string& folder,
                                   const std::string& file,
                                   int64_t max_bytes) const override;

 private:
  explicit ImportRoot(PosixFile root) : root_(std::move(root)) {}

  absl::StatusOr<PosixFile> OpenBelow(const std::string& path, int flags) const;

  const PosixFile root_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_IMPORT_ROOT_H_
