#include "server/rpc/operation_registry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "argmesh/v1/admin_service.pb.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/engine/uid.h"
#include "server/rpc/call_scope.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/operation_record.h"
#include "server/rpc/resource_name.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;
using google::protobuf::Any;

absl::Status NotFound(std::string_view id) {
  return MakeError(ErrorReason::kOperationNotFound,
                   absl::StrFormat("there is no operation %s", std::string(id)),
                   {{"operation", std::string(id)}});
}

}  // namespace

Any Packed(const google::protobuf::Message& message) {
  Any any;
  any.PackFrom(message);
  return any;
}

OperationRegistry::OperationRegistry(EventLog& log, OperationStore* store)
    : log_(log), memory_(store, log) {
  for (Operation& operation : memory_.Recall()) {
    const auto entry = std::make_shared<Entry>();
    entry->operation = std::move(operation);
    entry->number = next_number_++;
    entries_.emplace(OperationId(entry->operation), entry);
  }
  for (const std::string& id : DropOldest()) memory_.Forget(id);
}

OperationRegistry::~OperationRegistry() { EndAll(); }

absl::StatusOr<Operation> OperationRegistry::Start(std::string_view method,
                                                   std::string_view resource,
                                                   Work work) {
  const std::string id = MakeUid();
  auto entry = std::make_shared<Entry>();
  entry->operation.set_name(OperationName(id));
  ChangeMetadata(entry->operation, [&](v1::OperationMetadata& metadata) {
    metadata.set_method(std::string(method));
    metadata.set_resource(std::string(resource));
    *metadata.mutable_create_time() = ToTimestamp(absl::Now());
  });
  const Operation begun = entry->operation;
  std::vector<std::string> dropped;
  {
    const std::lock_guard lock(mutex_);
    if (running_.size() >= kMaxRunning) {
      return WithRetryDelay(
          MakeError(ErrorReason::kOverloaded,
                    absl::StrFormat("%d operations are running, the limit",
                                    kMaxRunning),
                    {{"limit", absl::StrFormat("%d", kMaxRunning)},
                     {"what", "operations"}}),
          absl::Seconds(10));
    }
    running_.push_back(entry);
    entry->number = next_number_++;
    entries_.emplace(id, entry);
    dropped = DropOldest();
  }
  memory_.Keep(id, begun);
  for (const std::string& oldest : dropped) memory_.Forget(oldest);
  ForgetIfDeleted(*entry);
  try {
    // Not joined: the destructor waits until none is left.
    std::thread([this, entry, work = std::move(work)] {
      Run(entry, work);
    }).detach();
  } catch (...) {
    End(*entry, CallScope::CurrentException());
  }
  return begun;
}

void OperationRegistry::Run(const std::shared_ptr<Entry>& entry,
                            const Work& work) {
  absl::StatusOr<Any> result = absl::CancelledError();
  try {
    result =
        work({StopToken(entry->stop.get_token(), absl::InfiniteFuture()),
              [&](const RunProgress& progress) { Report(*entry, progress); }});
  } catch (...) {
    result = CallScope::CurrentException();
  }
  End(*entry, result);
}

void OperationRegistry::Report(Entry& entry, const RunProgress& progress) {
  const std::lock_guard lock(mutex_);
  ChangeMetadata(entry.operation, [&](v1::OperationMetadata& metadata) {
    metadata.set_items(progress.items);
    metadata.set_items_done(progress.done);
    metadata.set_items_failed(progress.failed);
  });
}

void OperationRegistry::End(Entry& entry, const absl::StatusOr<Any>& result) {
  const std::string name = entry.operation.name();
  log_.Write(result.ok() ? LogLevel::kInfo : LogLevel::kWarning,
             "operation ended",
             {{"operation", name}, {"status", result.status().ToString()}});
  Operation ended;
  {
    const std::lock_guard lock(mutex_);
    ended = entry.operation;
  }
  EndOperation(ended, result);
  // Before anybody is told.
  memory_.Keep(OperationId(ended), ended);
  ForgetIfDeleted(entry);
  const std::lock_guard lock(mutex_);
  entry.operation = std::move(ended);
  std::erase_if(running_,
                [&](const auto& other) { return other.get() == &entry; });
  // Under the lock: the registry may be gone right after it.
  ended_.notify_all();
}

void OperationRegistry::ForgetIfDeleted(const Entry& entry) {
  std::string id;
  {
    const std::lock_guard lock(mutex_);
    if (!entry.forgotten) return;
    id = OperationId(entry.operation);
  }
  memory_.Forget(id);
}

std::shared_ptr<OperationRegistry::Entry> OperationRegistry::Find(
    std::string_view id) const {
  const auto it = entries_.find(id);
  return it == entries_.end() ? nullptr : it->second;
}

std::vector<std::string> OperationRegistry::DropOldest() {
  std::vector<std::pair<int64_t, std::string>> ended;  // by number
  size_t bytes = 0;
  for (const auto& [id, entry] : entries_) {
    bytes += entry->operation.ByteSizeLong();
    if (entry->operation.done()) ended.emplace_back(entry->number, id);
  }
  std::sort(ended.begin(), ended.end());
  std::vector<std::string> dropped;
  for (const auto& [number, id] : ended) {
    if (entries_.size() <= kMaxKept && bytes <= kMaxKeptBytes) break;
    const auto oldest = entries_.find(id);
    bytes -= oldest->second->operation.ByteSizeLong();
    entries_.erase(oldest);
    dropped.push_back(id);
  }
  return dropped;
}

absl::StatusOr<Operation> OperationRegistry::Get(std::string_view id) const {
  const std::lock_guard lock(mutex_);
  const std::shared_ptr<Entry> entry = Find(id);
  if (entry == nullptr) return NotFound(id);
  return entry->operation;
}

absl::Status OperationRegistry::Cancel(std::string_view id) {
  const std::lock_guard lock(mutex_);
  const std::shared_ptr<Entry> entry = Find(id);
  if (entry == nullptr) return NotFound(id);
  entry->stop.request_stop();
  return absl::OkStatus();
}

absl::Status OperationRegistry::Delete(std::string_view id) {
  {
    const std::lock_guard lock(mutex_);
    const auto it = entries_.find(id);
    if (it == entries_.end()) return NotFound(id);
    it->second->forgotten = true;
    entries_.erase(it);
  }
  memory_.Forget(id);
  return absl::OkStatus();
}

OperationRegistry::Page OperationRegistry::List(std::string_view after_id,
                                                int limit,
                                                int64_t max_bytes) const {
  const std::lock_guard lock(mutex_);
  Page page;
  int64_t bytes = 0;
  for (auto it = entries_.upper_bound(after_id); it != entries_.end(); ++it) {
    const Operation& operation = it->second->operation;
    const auto count = static_cast<int>(page.operations.size());
    bytes += static_cast<int64_t>(operation.ByteSizeLong());
    if (count == limit || (count > 0 && bytes > max_bytes)) {
      page.more = true;
      break;
    }
    page.operations.push_back(operation);
  }
  return page;
}

int OperationRegistry::running() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(running_.size());
}

void OperationRegistry::CancelAll() {
  const std::lock_guard lock(mutex_);
  for (const auto& entry : running_) entry->stop.request_stop();
}

void OperationRegistry::EndAll() {
  CancelAll();
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return running_.empty(); });
}

}  // namespace argmesh
