// Port: mesh files on the server's own disk that may be imported.
//
// Nothing outside the root is ever opened, whatever the paths say: no "..",
// no absolute path, no symbolic link on the way. Thread-safe.
//
// Fails    kFileUnreadable, with metadata `path`
#ifndef ARGMESH_SERVER_ENGINE_IMPORT_SOURCE_H_
#define ARGMESH_SERVER_ENGINE_IMPORT_SOURCE_H_

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"

namespace argmesh {

class ImportSource {
 public:
  virtual ~ImportSource() = default;

  // Files at any depth below `folder` (relative to the root; empty: the root),
  // relative to it, ascending. Hidden files and folders are left out; links are
  // listed, for Read to refuse. kCancelled, kDeadlineExceeded.
  virtual absl::StatusOr<std::vector<std::string>> ListFiles(
      const std::string& folder, const StopToken& stop) const = 0;

  // The bytes of one of them. kMeshTooLarge over `max_bytes`.
  virtual absl::StatusOr<std::string> Read(const std::string& folder,
                                           const std::string& file,
                                           int64_t max_bytes) const = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_IMPORT_SOURCE_H_
