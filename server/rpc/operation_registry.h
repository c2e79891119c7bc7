// Long-running work: started by one call, watched and ended by others.
//
// Each operation has a thread of its own; at most kMaxRunning run. What has
// ended is remembered until there are kMaxKept, or kMaxKeptBytes, also by the
// next process (operation_memory.h); what runs ends with the process.
// Thread-safe.
#ifndef ARGMESH_SERVER_RPC_OPERATION_REGISTRY_H_
#define ARGMESH_SERVER_RPC_OPERATION_REGISTRY_H_

#include <google/protobuf/any.pb.h>

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "google/longrunning/operations.pb.h"
#include "server/engine/item_run.h"
#include "server/engine/operation_store.h"
#include "server/rpc/operation_memory.h"
#include "server/telemetry/event_log.h"

namespace argmesh {

google::protobuf::Any Packed(const google::protobuf::Message& message);

class OperationRegistry {
 public:
  static constexpr size_t kMaxRunning = 4;
  static constexpr size_t kMaxKept = 1000;
  static constexpr size_t kMaxKeptBytes = 64 << 20;

  // The response, packed. What it reports is in the operation's metadata.
  using Work =
      std::function<absl::StatusOr<google::protobuf::Any>(const RunControl&)>;

  // With the operations that `store` has; none: it remembers its own only. How
  // operations end goes to `log`. Both must outlive the registry.
  explicit OperationRegistry(EventLog& log, OperationStore* store = nullptr);
  ~OperationRegistry();  // EndAll

  // `method` is the rpc, `resource` what it is about. OVERLOADED.
  absl::StatusOr<google::longrunning::Operation> Start(
      std::string_view method, std::string_view resource, Work work);

  // By UUID. OPERATION_NOT_FOUND.
  absl::StatusOr<google::longrunning::Operation> Get(std::string_view id) const;
  // It ends soon with CANCELLED, unless it was nearly done.
  absl::Status Cancel(std::string_view id);
  // Forgets it; it runs on.
  absl::Status Delete(std::string_view id);
  // Those after `after_id`, by UUID: at most `limit` >= 1, and no more than fit
  // in `max_bytes`, but one.
  struct Page {
    std::vector<google::longrunning::Operation> operations;
    bool more = false;  // there are others after them
  };
  Page List(std::string_view after_id, int limit, int64_t max_bytes) const;

  void CancelAll();
  // CancelAll, and waits until none runs.
  void EndAll();
  int running() const;

 private:
  struct Entry {
    google::longrunning::Operation operation;
    int64_t number = 0;      // in the order of their starts
    bool forgotten = false;  // with the mutex
    std::stop_source stop;
  };

  void Run(const std::shared_ptr<Entry>& entry, const Work& work);
  void Report(Entry& entry, const RunProgress& progress);
  void End(Entry& entry, const absl::StatusOr<google::protobuf::Any>& result);
  void ForgetIfDeleted(const Entry& entry);
  std::shared_ptr<Entry> Find(std::string_view id) const;  // with the mutex
  // Of what has ended, as much as is too much; the ids. With the mutex.
  std::vector<std::string> DropOldest();

  EventLog& log_;
  OperationMemory memory_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::map<std::string, std::shared_ptr<Entry>, std::less<>> entries_;
  int64_t next_number_ = 0;
  std::vector<std::shared_ptr<Entry>> running_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_OPERATION_REGISTRY_H_
