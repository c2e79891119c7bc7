// The one mapping of absl::Status to what a gRPC client sees.
//
// Every error carries google.rpc.ErrorInfo{reason, "argmesh.v1", metadata} in
// its details; QuotaFailure, RetryInfo, ResourceInfo, BadRequest and
// PreconditionFailure where the code asks for them. An internal error shows no
// internals: its message goes to the log under the id in RequestInfo.
#ifndef ARGMESH_SERVER_RPC_STATUS_H_
#define ARGMESH_SERVER_RPC_STATUS_H_

#include <grpcpp/support/status.h>

#include <string_view>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "google/rpc/status.pb.h"

namespace argmesh {

// Of every ErrorInfo.
inline constexpr char kErrorDomain[] = "argmesh.v1";

// `request_id` names the call in the log; only internal errors show it.
google::rpc::Status ToProtoStatus(const absl::Status& status,
                                  std::string_view request_id = {});
grpc::Status ToGrpcStatus(const google::rpc::Status& status);

// kUnimplemented METHOD_NOT_SERVED. `method` is "SearchService.SearchShapes".
absl::Status MethodNotServed(std::string_view method);

// kInvalidArgument FIELD_INVALID and FIELD_REQUIRED with metadata `field`.
absl::Status FieldInvalid(std::string_view field, std::string_view why);
absl::Status FieldRequired(std::string_view field);

// STREAM_IDLE: the peer said nothing for `limit`.
absl::Status StreamIdle(absl::Duration limit);
// STREAM_IDLE: it said nothing, or too little (peer_pace.h).
absl::Status StreamTooSlow(absl::Duration limit);
// STREAM_ORDER_INVALID.
absl::Status StreamOrderInvalid(std::string_view why);
// OVERLOADED, for a request that has not come whole.
absl::Status TooManySlowRequests();
// OVERLOADED, for a call of a connection that does not take its answers.
absl::Status TooManyUnreadAnswers();
// OVERLOADED, for a connection that is cut.
absl::Status TooManyCallsOfAConnection();
// DRAINING.
absl::Status ServerDraining();

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_STATUS_H_
