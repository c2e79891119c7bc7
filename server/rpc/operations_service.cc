#include "server/rpc/operations_service.h"

#include "core/base/status_macros.h"
#include "server/engine/page_token.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"
#include "server/rpc/unary_reactor.h"
#include "server/rpc/wait_reactor.h"

namespace argmesh {
namespace {

constexpr char kList[] = "operations";

absl::Status List(const OperationRegistry& operations,
                  const google::longrunning::ListOperationsRequest& request,
                  google::longrunning::ListOperationsResponse* response) {
  if (!request.filter().empty()) {
    return FieldInvalid("filter", "not served by this version; leave it empty");
  }
  ARGMESH_ASSIGN_OR_RETURN(const int limit, CheckPageSize(request.page_size()));
  ARGMESH_ASSIGN_OR_RETURN(const std::string after,
                           ParsePageToken(kList, request.page_token()));
  for (google::longrunning::Operation& operation :
       operations.List(after, limit)) {
    *response->add_operations() = std::move(operation);
  }
  if (response->operations_size() == limit) {
    ARGMESH_ASSIGN_OR_RETURN(
        const std::string last,
        ParseOperationName("name", response->operations(limit - 1).name()));
    response->set_next_page_token(MakePageToken(kList, last));
  }
  return absl::OkStatus();
}

// A call that does something to the operation it names and answers nothing.
template <typename Request>
grpc::ServerUnaryReactor* ActOnNamed(
    ServiceEnvironment& environment, grpc::CallbackServerContext* context,
    const Request* request, google::protobuf::Empty* response,
    const char* method,
    absl::Status (OperationRegistry::*act)(std::string_view)) {
  return UnaryReactor::Start(
      environment, context, {request, response}, {method},
      [&environment, request, act](const UnaryCall&) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                                 ParseOperationName("name", request->name()));
        return (environment.operations.*act)(id);
      });
}

}  // namespace

grpc::ServerUnaryReactor* OperationsServiceImpl::ListOperations(
    grpc::CallbackServerContext* context,
    const google::longrunning::ListOperationsRequest* request,
    google::longrunning::ListOperationsResponse* response) {
  return UnaryReactor::Start(
      environment_, context, {request, response}, {"Operations.ListOperations"},
      [this, request, response](const UnaryCall&) {
        return List(environment_.operations, *request, response);
      });
}

grpc::ServerUnaryReactor* OperationsServiceImpl::GetOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::GetOperationRequest* request,
    google::longrunning::Operation* response) {
  return UnaryReactor::Start(
      environment_, context, {request, response}, {"Operations.GetOperation"},
      [this, request, response](const UnaryCall&) -> absl::Status {
        ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                                 ParseOperationName("name", request->name()));
        ARGMESH_ASSIGN_OR_RETURN(*response, environment_.operations.Get(id));
        return absl::OkStatus();
      });
}

grpc::ServerUnaryReactor* OperationsServiceImpl::DeleteOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::DeleteOperationRequest* request,
    google::protobuf::Empty* response) {
  return ActOnNamed(environment_, context, request, response,
                    "Operations.DeleteOperation", &OperationRegistry::Delete);
}

grpc::ServerUnaryReactor* OperationsServiceImpl::CancelOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::CancelOperationRequest* request,
    google::protobuf::Empty* response) {
  return ActOnNamed(environment_, context, request, response,
                    "Operations.CancelOperation", &OperationRegistry::Cancel);
}

grpc::ServerUnaryReactor* OperationsServiceImpl::WaitOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::WaitOperationRequest* request,
    google::longrunning::Operation* response) {
  return StartReactor<WaitReactor>(environment_, context, request, response);
}

}  // namespace argmesh
