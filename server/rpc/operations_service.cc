#include "server/rpc/operations_service.h"

#include "server/rpc/unary_reactor.h"

namespace argmesh {

grpc::ServerUnaryReactor* OperationsServiceImpl::ListOperations(
    grpc::CallbackServerContext* context,
    const google::longrunning::ListOperationsRequest*,
    google::longrunning::ListOperationsResponse*) {
  return UnaryReactor::NotServed(environment_, context,
                                 "Operations.ListOperations");
}

grpc::ServerUnaryReactor* OperationsServiceImpl::GetOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::GetOperationRequest*,
    google::longrunning::Operation*) {
  return UnaryReactor::NotServed(environment_, context,
                                 "Operations.GetOperation");
}

grpc::ServerUnaryReactor* OperationsServiceImpl::DeleteOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::DeleteOperationRequest*,
    google::protobuf::Empty*) {
  return UnaryReactor::NotServed(environment_, context,
                                 "Operations.DeleteOperation");
}

grpc::ServerUnaryReactor* OperationsServiceImpl::CancelOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::CancelOperationRequest*,
    google::protobuf::Empty*) {
  return UnaryReactor::NotServed(environment_, context,
                                 "Operations.CancelOperation");
}

grpc::ServerUnaryReactor* OperationsServiceImpl::WaitOperation(
    grpc::CallbackServerContext* context,
    const google::longrunning::WaitOperationRequest*,
    google::longrunning::Operation*) {
  return UnaryReactor::NotServed(environment_, context,
                                 "Operations.WaitOperation");
}

}  // namespace argmesh
