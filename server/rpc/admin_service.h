// argmesh.v1.AdminService.
#ifndef ARGMESH_SERVER_RPC_ADMIN_SERVICE_H_
#define ARGMESH_SERVER_RPC_ADMIN_SERVICE_H_

#include "server/rpc/rpc_service.h"

namespace argmesh {

class AdminServiceImpl final : public RpcService {
 public:
  // `environment` must outlive the service.
  explicit AdminServiceImpl(ServiceEnvironment& environment);
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ADMIN_SERVICE_H_
