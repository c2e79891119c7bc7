#include "server/rpc/operation_memory.h"

#include <map>
#include <string>
#include <utility>

#include "absl/time/time.h"
#include "server/engine/error_reason.h"
#include "server/rpc/operation_record.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;

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
  if (store_ == nullptr) return {};
  const auto kept = store_->ReadAll();
  if (!kept.ok()) {
    Warn("operations not read", "", kept.status());
    return {};
  }
  std::multimap<absl::Time, Operation> by_begin;
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
      EndOperation(operation,
                   MakeError(ErrorReason::kCancelled,
                             "the server ended before the operation did: call "
                             "again"));
      Keep(one.id, operation);
    }
    const absl::Time begin = BeginTime(operation);
    by_begin.emplace(begin, std::move(operation));
  }
  std::vector<Operation> operations;
  operations.reserve(by_begin.size());
  for (auto& [begin, operation] : by_begin) {
    operations.push_back(std::move(operation));
  }
  return operations;
}

void OperationMemory::Warn(const char* what, std::string_view id,
                           const absl::Status& why) {
  log_.Write(LogLevel::kWarning, what,
             {{"operation", std::string(id)}, {"error", why.ToString()}});
}

}  // namespace argmesh
