// How a caller follows a long-running operation of the server.
#ifndef ARGMESH_CLIENT_OPERATION_WATCH_H_
#define ARGMESH_CLIENT_OPERATION_WATCH_H_

#include <functional>
#include <stop_token>

#include "argmesh/v1/admin_service.pb.h"

namespace argmesh {

struct OperationWatch {
  // Several times a second while it runs, and at its end.
  std::function<void(const v1::OperationMetadata&)> progress;
  // A request cancels the operation, which then ends with kCancelled.
  std::stop_token stop;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_OPERATION_WATCH_H_
