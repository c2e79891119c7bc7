// google.longrunning.Operations.
#ifndef ARGMESH_SERVER_RPC_OPERATIONS_SERVICE_H_
#define ARGMESH_SERVER_RPC_OPERATIONS_SERVICE_H_

#include "google/longrunning/operations.grpc.pb.h"
#include "server/rpc/service_environment.h"

namespace argmesh {

class OperationsServiceImpl final
    : public google::longrunning::Operations::CallbackService {
 public:
  // `environment` must outlive the service.
  explicit OperationsServiceImpl(ServiceEnvironment& environment)
      : environment_(environment) {}

  grpc::ServerUnaryReactor* ListOperations(
      grpc::CallbackServerContext* context,
      const google::longrunning::ListOperationsRequest* request,
      google::longrunning::ListOperationsResponse* response) override;
  grpc::ServerUnaryReactor* GetOperation(
      grpc::CallbackServerContext* context,
      const google::longrunning::GetOperationRequest* request,
      google::longrunning::Operation* response) override;
  grpc::ServerUnaryReactor* DeleteOperation(
      grpc::CallbackServerContext* context,
      const google::longrunning::DeleteOperationRequest* request,
      google::protobuf::Empty* response) override;
  grpc::ServerUnaryReactor* CancelOperation(
      grpc::CallbackServerContext* context,
      const google::longrunning::CancelOperationRequest* request,
      google::protobuf::Empty* response) override;
  grpc::ServerUnaryReactor* WaitOperation(
      grpc::CallbackServerContext* context,
      const google::longrunning::WaitOperationRequest* request,
      google::longrunning::Operation* response) override;

 private:
  ServiceEnvironment& environment_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_OPERATIONS_SERVICE_H_
