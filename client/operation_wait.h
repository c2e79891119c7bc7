// Waiting for a long-running operation, and ending one; only the client library
// includes this.
#ifndef ARGMESH_CLIENT_OPERATION_WAIT_H_
#define ARGMESH_CLIENT_OPERATION_WAIT_H_

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/client.h"
#include "client/client_parts.h"

namespace argmesh {

// Asks for its end, and does not wait for it.
absl::Status RequestCancel(Client::Parts& parts, const std::string& name);

// The operation when it is done.
absl::StatusOr<google::longrunning::Operation> AwaitEnd(
    Client::Parts& parts, google::longrunning::Operation operation,
    const OperationWatch& watch);

// Its response. kInternal when that is of another type.
template <typename Response>
absl::StatusOr<Response> Await(Client::Parts& parts,
                               google::longrunning::Operation operation,
                               const OperationWatch& watch = {}) {
  const absl::StatusOr<google::longrunning::Operation> ended =
      AwaitEnd(parts, std::move(operation), watch);
  if (!ended.ok()) return ended.status();
  if (ended->has_error()) return ToStatus(ended->error());
  Response response;
  if (!ended->response().UnpackTo(&response)) {
    return absl::InternalError("the operation's answer is of another type");
  }
  return response;
}

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_OPERATION_WAIT_H_
