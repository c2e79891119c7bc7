#include "server/rpc/operation_record.h"

#include "absl/time/clock.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;

v1::OperationMetadata MetadataOf(const Operation& operation) {
  v1::OperationMetadata metadata;
  operation.metadata().UnpackTo(&metadata);
  return metadata;
}

}  // namespace

std::string OperationId(const Operation& operation) {
  return operation.name().substr(operation.name().find('/') + 1);
}

absl::Time BeginTime(const Operation& operation) {
  const v1::OperationMetadata metadata = MetadataOf(operation);
  return absl::FromUnixSeconds(metadata.create_time().seconds()) +
         absl::Nanoseconds(metadata.create_time().nanos());
}

void ChangeMetadata(Operation& operation,
                    const std::function<void(v1::OperationMetadata&)>& change) {
  v1::OperationMetadata metadata = MetadataOf(operation);
  change(metadata);
  operation.mutable_metadata()->PackFrom(metadata);
}

void EndOperation(Operation& operation,
                  const absl::StatusOr<google::protobuf::Any>& result) {
  ChangeMetadata(operation, [](v1::OperationMetadata& metadata) {
    *metadata.mutable_end_time() = ToTimestamp(absl::Now());
  });
  operation.set_done(true);
  if (result.ok()) {
    *operation.mutable_response() = *result;
  } else {
    *operation.mutable_error() =
        ToProtoStatus(result.status(), operation.name());
  }
}

}  // namespace argmesh
