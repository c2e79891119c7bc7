#include "server/rpc/operations_service.h"

#include "server/rpc/unary_reactor.h"

namespace argmesh {

grpc::ServerUnaryReactor* OperationsServiceImpl::ListOperations(
    grpc::CallbackServerContext* context,
    const google::longrunning::ListOperationsRequest* request,
    google::longrunning::ListOperationsResponse*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "Operations.ListOperations");
}

grpc::ServerUnaryReactor* OperationsServiceImpl::GetOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::GetOperationRequest* request,
    google::longrunning::Operation*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "Operations.GetOperation");
}

grpc::ServerUnaryReactor* OperationsServiceImpl::DeleteOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::DeleteOperationRequest* request,
    google::protobuf::Empty*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "Operations.DeleteOperation");
}

grpc::ServerUnaryReactor* OperationsServiceImpl::CancelOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::CancelOperationRequest* request,
    google::protobuf::Empty*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "Operations.CancelOperation");
}

grpc::ServerUnaryReactor* OperationsServiceImpl::WaitOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::WaitOperationRequest* request,
    google::longrunning::Operation*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "Operations.WaitOperation");
}

}  // namespace argmesh
