// What every call has, whatever its kind: a place in the registry, a stop
// token of its deadline and cancellation, its caller, what is recorded of it,
// and a flag that it has been finished.
//
// The mutex guards the state of the reactor that owns the scope; a reactor
// starts its reads and writes under it, after it has seen finished() false.
#ifndef ARGMESH_SERVER_RPC_CALL_SCOPE_H_
#define ARGMESH_SERVER_RPC_CALL_SCOPE_H_

#include <google/protobuf/message.h>
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <mutex>
#include <stop_token>
#include <string>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "core/base/stop_token.h"
#include "google/rpc/status.pb.h"
#include "server/rpc/access_control.h"
#include "server/rpc/service_environment.h"
#include "server/telemetry/call_record.h"

namespace argmesh {

class CallScope {
 public:
  // `method` is "SearchService.SearchShapes" and must outlive the scope.
  CallScope(ServiceEnvironment& environment,
            grpc::CallbackServerContext* context, const char* method);

  ServiceEnvironment& environment() { return environment_; }
  grpc::CallbackServerContext* context() { return context_; }
  const std::string& peer() const { return record_.peer; }
  const StopToken& stop() const { return stop_; }
  absl::Time deadline() const { return stop_.deadline(); }
  std::mutex& mutex() { return mutex_; }

  void RequestStop() { stop_source_.request_stop(); }

  // With mutex(): the call has been finished.
  bool finished() const { return finished_; }
  // True the first time only. Takes mutex().
  bool MarkFinished();

  // Whether the caller may make this call, and no more than its key allows.
  // Once, before anything else of the call is done.
  absl::Status Authorize();
  // Whether the caller still may, and may what this message names. One that
  // names nothing is of the resource that was named first.
  absl::Status AuthorizeMessage(const google::protobuf::Message& message);
  // As of the last of these checks; not while the next is under way.
  const Caller& caller() const { return caller_; }

  // Gives back the caller's place among the calls of its key.
  void ReleaseQuota();

  // The call, or a part of it, has its turn on a pool. The first time counts.
  void MarkWorkBegin();
  // It has to wait for its turn again, which is the one that counts.
  void MarkWorkPostponed();

  // What the client sees of the call's end, and of an item of a stream.
  // Telemetry is told.
  grpc::Status Report(const absl::Status& status);
  google::rpc::Status ReportItem(const ShapeRef& item,
                                 const absl::Status& status);

  // The status of the exception that is being handled.
  static absl::Status CurrentException();

 private:
  google::rpc::Status Describe(const absl::Status& status, CallRecord& record);

  ServiceEnvironment& environment_;
  grpc::CallbackServerContext* context_;
  Caller caller_;
  KeyQuotas::Ticket quota_;  // with mutex_
  CallRecord record_;        // with mutex_ once the call has begun
  std::stop_source stop_source_;
  StopToken stop_;
  std::mutex mutex_;
  bool finished_ = false;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CALL_SCOPE_H_
