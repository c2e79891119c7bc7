// What every call has, whatever its kind: a place in the registry, a stop
// token of its deadline and cancellation, an id for the log, and a flag that
// it has been finished.
//
// The mutex guards the state of the reactor that owns the scope; a reactor
// starts its reads and writes under it, after it has seen finished() false.
#ifndef ARGMESH_SERVER_RPC_CALL_SCOPE_H_
#define ARGMESH_SERVER_RPC_CALL_SCOPE_H_

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <mutex>
#include <stop_token>
#include <string>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "core/base/stop_token.h"
#include "google/rpc/status.pb.h"
#include "server/rpc/service_environment.h"

namespace argmesh {

class CallScope {
 public:
  // `method` is "SearchService.SearchShapes" and must outlive the scope.
  CallScope(ServiceEnvironment& environment,
            grpc::CallbackServerContext* context, const char* method);

  ServiceEnvironment& environment() { return environment_; }
  grpc::CallbackServerContext* context() { return context_; }
  const StopToken& stop() const { return stop_; }
  absl::Time deadline() const { return stop_.deadline(); }
  std::mutex& mutex() { return mutex_; }

  void RequestStop() { stop_source_.request_stop(); }

  // With mutex(): the call has been finished.
  bool finished() const { return finished_; }
  // True the first time only. Takes mutex().
  bool MarkFinished();

  // What the client sees. An internal error goes to the log.
  grpc::Status Report(const absl::Status& status);
  google::rpc::Status ReportProto(const absl::Status& status);

  // The status of the exception that is being handled.
  static absl::Status CurrentException();

 private:
  ServiceEnvironment& environment_;
  grpc::CallbackServerContext* context_;
  const char* method_;
  std::stop_source stop_source_;
  StopToken stop_;
  std::mutex mutex_;
  bool finished_ = false;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CALL_SCOPE_H_
