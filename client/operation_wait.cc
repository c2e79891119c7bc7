#include "client/operation_wait.h"

#include "core/base/status_macros.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;

// The server answers a wait at least so often: well within any call's time,
// and soon enough for those who watch.
constexpr int kWaitMilliseconds = 5000;
constexpr int kWatchMilliseconds = 250;

void Tell(const Operation& operation, const OperationWatch& watch) {
  v1::OperationMetadata metadata;
  if (watch.progress && operation.metadata().UnpackTo(&metadata)) {
    watch.progress(metadata);
  }
}

}  // namespace

absl::Status RequestCancel(Client::Parts& parts, const std::string& name) {
  google::longrunning::CancelOperationRequest request;
  request.set_name(name);
  return parts
      .Call<google::protobuf::Empty>(
          Repeat::kSafe,
          [&](grpc::ClientContext* context, auto* response) {
            return parts.operations->CancelOperation(context, request,
                                                     response);
          })
      .status();
}

absl::StatusOr<Operation> AwaitEnd(Client::Parts& parts, Operation operation,
                                   const OperationWatch& watch) {
  google::longrunning::WaitOperationRequest request;
  request.set_name(operation.name());
  const int wait = watch.progress ? kWatchMilliseconds : kWaitMilliseconds;
  request.mutable_timeout()->set_seconds(wait / 1000);
  request.mutable_timeout()->set_nanos(wait % 1000 * 1'000'000);
  bool cancelled = false;
  while (!operation.done()) {
    if (watch.stop.stop_requested() && !cancelled) {
      ARGMESH_RETURN_IF_ERROR(RequestCancel(parts, operation.name()));
      cancelled = true;
    }
    ARGMESH_ASSIGN_OR_RETURN(
        operation,
        parts.Call<Operation>(Repeat::kSafe, [&](grpc::ClientContext* context,
                                                 auto* response) {
          return parts.operations->WaitOperation(context, request, response);
        }));
    Tell(operation, watch);
  }
  return operation;
}

absl::StatusOr<v1::ReindexCollectionResponse> Client::ReindexCollection(
    const v1::ReindexCollectionRequest& request, const OperationWatch& watch) {
  ARGMESH_ASSIGN_OR_RETURN(
      const Operation operation,
      parts_->Call<Operation>(
          Repeat::kNever, [&](grpc::ClientContext* context, auto* response) {
            return parts_->collections->ReindexCollection(context, request,
                                                          response);
          }));
  return Await<v1::ReindexCollectionResponse>(*parts_, operation, watch);
}

absl::StatusOr<v1::ImportShapesResponse> Client::ImportShapes(
    const v1::ImportShapesRequest& request, const OperationWatch& watch) {
  ARGMESH_ASSIGN_OR_RETURN(
      const Operation operation,
      parts_->Call<Operation>(
          Repeat::kNever, [&](grpc::ClientContext* context, auto* response) {
            return parts_->ingest->ImportShapes(context, request, response);
          }));
  return Await<v1::ImportShapesResponse>(*parts_, operation, watch);
}

}  // namespace argmesh
