// Port: what is remembered of a server's long-running work beyond its process.
//
// Fails    by MakeError: kStoreFull, kStoreUnavailable.
// Thread-safe. Calls block for about one write to the disk.
#ifndef ARGMESH_SERVER_ENGINE_OPERATION_STORE_H_
#define ARGMESH_SERVER_ENGINE_OPERATION_STORE_H_

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace argmesh {

struct KeptOperation {
  std::string id;
  // kStoredDataDamaged; kStoreUnavailable, also of another version.
  absl::StatusOr<std::string> bytes;
};

class OperationStore {
 public:
  virtual ~OperationStore() = default;

  // In place of what is kept under `id`, a UUID; durable when it returns OK.
  virtual absl::Status Keep(std::string_view id, std::string_view bytes) = 0;
  // OK also when nothing is kept.
  virtual absl::Status Forget(std::string_view id) = 0;
  // By id, ascending.
  virtual absl::StatusOr<std::vector<KeptOperation>> ReadAll() const = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_OPERATION_STORE_H_
