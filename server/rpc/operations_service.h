// google.longrunning.Operations.
#ifndef ARGMESH_SERVER_RPC_OPERATIONS_SERVICE_H_
#define ARGMESH_SERVER_RPC_OPERATIONS_SERVICE_H_

#include "server/rpc/rpc_service.h"

namespace argmesh {

class OperationsServiceImpl final : public RpcService {
 public:
  // `environment` must outlive the service.
  explicit OperationsServiceImpl(ServiceEnvironment& environment);
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_OPERATIONS_SERVICE_H_
