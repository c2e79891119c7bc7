// Errors of a call as absl::Status, with what the server said about them.
//
// The message reads "SHAPE_NOT_FOUND: no shape ..."; the reason is also kept
// apart for programs.
#ifndef ARGMESH_CLIENT_ERROR_STATUS_H_
#define ARGMESH_CLIENT_ERROR_STATUS_H_

#include <grpcpp/support/status.h>

#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "google/rpc/status.pb.h"

namespace argmesh {

absl::Status ToStatus(const grpc::Status& status);
absl::Status ToStatus(const google::rpc::Status& status);

// An error of the client itself in the form of the server's.
absl::Status MakeStatus(absl::StatusCode code, std::string_view reason,
                        std::string_view message);

// google.rpc.ErrorInfo.reason, "MESH_MALFORMED"; empty without one.
std::string ErrorReason(const absl::Status& status);

// The message without the reason.
std::string ErrorText(const absl::Status& status);

// The wait the server asks for; zero without RetryInfo.
absl::Duration RetryDelay(const absl::Status& status);

// The server could not be reached, is going down or asks for a later attempt.
bool IsRetryable(const absl::Status& status);

// No server answered at all: kUnavailable without a word of the server's.
bool IsUnreachable(const absl::Status& status);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_ERROR_STATUS_H_
