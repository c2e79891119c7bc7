#include "server/rpc/operation_memory.h"

#include <algorithm>
#include <string>
#include <utility>

#include "absl/time/clock.h"
#include "argmesh/v1/admin_service.pb.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;

v1::OperationMetadata MetadataOf(const Operation& operation) {
  v1::OperationMetadata metadata;
  operation.metadata().UnpackTo(&metadata);
  return metadata;
}

absl::Time Began(const Operation& operation) {
  const auto& time = MetadataOf(operation).create_time();
  return absl::FromUnixSeconds(time.seconds()) +
         absl::Nanoseconds(time.nanos());
}

void EndAsInterrupted(Operation& operation) {
  v1::OperationMetadata metadata = MetadataOf(operation);
  *metadata.mutable_end_time() = ToTimestamp(absl::Now());
  operation.mutable_metadata()->PackFrom(metadata);
  operation.set_done(true);
  *operation.mutable_error() = ToProtoStatus(
      MakeError(ErrorReason::kCancelled,
                "the server ended before the operation did: call again"));
}

}  // namespace

void OperationMemory::Keep(std::string_view id, const Operation& as_is) {
  if (store_ == nullptr) return;
  const absl::Status kept = store_->Keep(id, as_is.SerializeAsString());
  if (kept.ok()) return;
  Warn("operation not kept", id, kept);
  // It is not what was kept of it before.
  Forget(id);
}

void OperationMemory::Forget(std::string_view id) {
  if (store_ == nullptr) return;
  const absl::Status forgotten = store_->Forget(id);
  if (!forgotten.ok()) Warn("operation not forgotten", id, forgotten);
}

std::vector<Operation> OperationMemory::Recall() {
  std::vector<Operation> operations;
  if (store_ == nullptr) return operations;
  const auto kept = store_->ReadAll();
  if (!kept.ok()) {
    Warn("operations not read", "", kept.status());
    return operations;
  }
  for (const KeptOperation& one : *kept) {
    Operation operation;
    absl::Status read = one.bytes.status();
    if (read.ok() && !operation.ParseFromString(*one.bytes)) {
      read = MakeError(ErrorReason::kStoredDataDamaged, "no operation");
    }
    if (!read.ok()) {
      Warn("operation not read", one.id, read);
      if (ReasonOf(read) == ErrorReason::kStoredDataDamaged) Forget(one.id);
      continue;
    }
    if (!operation.done()) {
      EndAsInterrupted(operation);
      Keep(one.id, operation);
    }
    operations.push_back(std::move(operation));
  }
  std::stable_sort(operations.begin(), operations.end(),
                   [](const Operation& a, const Operation& b) {
                     return Began(a) < Began(b);
                   });
  return operations;
}

void OperationMemory::Warn(const char* what, std::string_view id,
                           const absl::Status& why) {
  log_.Write(LogLevel::kWarning, what,
             {{"operation", std::string(id)}, {"error", why.ToString()}});
}

}  // namespace argmesh
