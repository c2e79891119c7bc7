// What a google.longrunning.Operation of this server says of itself.
#ifndef ARGMESH_SERVER_RPC_OPERATION_RECORD_H_
#define ARGMESH_SERVER_RPC_OPERATION_RECORD_H_

#include <google/protobuf/any.pb.h>

#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "argmesh/v1/admin_service.pb.h"
#include "google/longrunning/operations.pb.h"

namespace argmesh {

// The UUID in its name.
std::string OperationId(const google::longrunning::Operation& operation);

absl::Time BeginTime(const google::longrunning::Operation& operation);

void ChangeMetadata(google::longrunning::Operation& operation,
                    const std::function<void(v1::OperationMetadata&)>& change);

// It is done from now on, with this result.
void EndOperation(google::longrunning::Operation& operation,
                  const absl::StatusOr<google::protobuf::Any>& result);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_OPERATION_RECORD_H_
