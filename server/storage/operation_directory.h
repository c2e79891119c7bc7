// Operations as files, one each, named after its id.
//
// A file is written beside, made durable and then renamed, so that there is the
// one before or the new one, whole; its bytes are sealed (sealed_bytes.h).
// What a crash left unfinished is removed when the folder is opened.
#ifndef ARGMESH_SERVER_STORAGE_OPERATION_DIRECTORY_H_
#define ARGMESH_SERVER_STORAGE_OPERATION_DIRECTORY_H_

#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/engine/operation_store.h"
#include "server/storage/data_directory.h"

namespace argmesh {

class OperationDirectory : public OperationStore {
 public:
  static absl::StatusOr<std::unique_ptr<OperationDirectory>> Open(
      std::shared_ptr<const DataDirectory> directory);

  absl::Status Keep(std::string_view id, std::string_view bytes) override;
  absl::Status Forget(std::string_view id) override;
  absl::StatusOr<std::vector<KeptOperation>> ReadAll() const override;

 private:
  explicit OperationDirectory(std::shared_ptr<const DataDirectory> directory)
      : directory_(std::move(directory)) {}

  const std::shared_ptr<const DataDirectory> directory_;
  mutable std::mutex mutex_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_OPERATION_DIRECTORY_H_
