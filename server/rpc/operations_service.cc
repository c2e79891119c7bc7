#include "server/rpc/operations_service.h"

#include "core/base/status_macros.h"
#include "server/engine/page_token.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"
#include "server/rpc/wait_reactor.h"

namespace argmesh {
namespace {

constexpr char kList[] = "operations";

using google::longrunning::Operation;

absl::Status ListOperations(
    const UnaryCall& call,
    const google::longrunning::ListOperationsRequest& request,
    google::longrunning::ListOperationsResponse* response) {
  if (!request.filter().empty()) {
    return FieldInvalid("filter", "not served by this version; leave it empty");
  }
  ARGMESH_ASSIGN_OR_RETURN(const int limit, CheckPageSize(request.page_size()));
  ARGMESH_ASSIGN_OR_RETURN(const std::string after,
                           ParsePageToken(kList, request.page_token()));
  OperationRegistry::Page page =
      call.environment.operations.List(after, limit, kMaxAnswerBytes);
  for (Operation& operation : page.operations) {
    *response->add_operations() = std::move(operation);
  }
  if (page.more) {
    ARGMESH_ASSIGN_OR_RETURN(
        const std::string last,
        ParseOperationName("name", response->operations().rbegin()->name()));
    response->set_next_page_token(MakePageToken(kList, last));
  }
  return absl::OkStatus();
}

absl::Status GetOperation(
    const UnaryCall& call,
    const google::longrunning::GetOperationRequest& request,
    Operation* response) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                           ParseOperationName("name", request.name()));
  ARGMESH_ASSIGN_OR_RETURN(*response, call.environment.operations.Get(id));
  return absl::OkStatus();
}

absl::Status DeleteOperation(
    const UnaryCall& call,
    const google::longrunning::DeleteOperationRequest& request,
    google::protobuf::Empty*) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                           ParseOperationName("name", request.name()));
  return call.environment.operations.Delete(id);
}

absl::Status CancelOperation(
    const UnaryCall& call,
    const google::longrunning::CancelOperationRequest& request,
    google::protobuf::Empty*) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                           ParseOperationName("name", request.name()));
  return call.environment.operations.Cancel(id);
}

}  // namespace

OperationsServiceImpl::OperationsServiceImpl(ServiceEnvironment& environment)
    : RpcService(environment, "google.longrunning") {
  Unary({"Operations.ListOperations"}, ListOperations);
  Unary({"Operations.GetOperation"}, GetOperation);
  Unary({"Operations.DeleteOperation"}, DeleteOperation);
  Unary({"Operations.CancelOperation"}, CancelOperation);
  Stream<WaitReactor>("Operations.WaitOperation");
}

}  // namespace argmesh
