// What is recorded of a call, whoever records it.
#ifndef ARGMESH_SERVER_TELEMETRY_CALL_RECORD_H_
#define ARGMESH_SERVER_TELEMETRY_CALL_RECORD_H_

#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "server/telemetry/trace_context.h"

namespace argmesh {

// As gRPC names it, with its package.
struct MethodName {
  std::string service;  // "argmesh.v1.ShapeService"
  std::string method;   // "GetShape"
};

// Of "ShapeService.GetShape".
MethodName FullName(std::string_view method);

struct CallRecord {
  // "ShapeService.GetShape"; outlives the record.
  std::string_view method;
  bool writes = false;    // changes what is stored: goes to the audit log
  std::string resource;   // the first one the request names
  std::string principal;  // who calls; empty: nobody is asked
  std::string peer;       // "ipv4:127.0.0.1:40312"
  TraceContext trace;

  // From here on as the call ended.
  absl::StatusCode code = absl::StatusCode::kOk;
  std::string reason;      // ErrorReason's name; empty when OK
  std::string request_id;  // what an internal error shows to the client
  std::string internals;   // of an internal error; never shown to the client
  absl::Time begin;
  absl::Time work_begin = absl::InfiniteFuture();  // on a pool; never: infinite
  absl::Time end;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_CALL_RECORD_H_
