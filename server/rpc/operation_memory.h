// What the server remembers of its operations from one process to the next.
//
// An operation is kept as it begins and as it ends. One that the store has as
// begun was not ended by its process: it is remembered as cancelled, and says
// why. What cannot be kept is said in the log and forgotten; the operation
// goes on. Thread-safe; calls block for about one write to the disk.
#ifndef ARGMESH_SERVER_RPC_OPERATION_MEMORY_H_
#define ARGMESH_SERVER_RPC_OPERATION_MEMORY_H_

#include <string_view>
#include <vector>

#include "google/longrunning/operations.pb.h"
#include "server/engine/operation_store.h"
#include "server/telemetry/event_log.h"

namespace argmesh {

class OperationMemory {
 public:
  // Without a `store` nothing is remembered. Both must outlive it.
  OperationMemory(OperationStore* store, EventLog& log)
      : store_(store), log_(log) {}

  void Keep(std::string_view id, const google::longrunning::Operation& as_is);
  void Forget(std::string_view id);
  // Of the processes before, in the order of their starts; all have ended.
  std::vector<google::longrunning::Operation> Recall();

 private:
  void Warn(const char* what, std::string_view id, const absl::Status& why);

  OperationStore* const store_;
  EventLog& log_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_OPERATION_MEMORY_H_
