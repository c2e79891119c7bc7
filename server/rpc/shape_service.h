// argmesh.v1.ShapeService.
#ifndef ARGMESH_SERVER_RPC_SHAPE_SERVICE_H_
#define ARGMESH_SERVER_RPC_SHAPE_SERVICE_H_

#include "server/rpc/rpc_service.h"

namespace argmesh {

class ShapeServiceImpl final : public RpcService {
 public:
  // `environment` must outlive the service.
  explicit ShapeServiceImpl(ServiceEnvironment& environment);
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_SHAPE_SERVICE_H_
