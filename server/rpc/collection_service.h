// argmesh.v1.CollectionService.
#ifndef ARGMESH_SERVER_RPC_COLLECTION_SERVICE_H_
#define ARGMESH_SERVER_RPC_COLLECTION_SERVICE_H_

#include "server/rpc/rpc_service.h"

namespace argmesh {

class CollectionServiceImpl final : public RpcService {
 public:
  // `environment` must outlive the service.
  explicit CollectionServiceImpl(ServiceEnvironment& environment);
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_COLLECTION_SERVICE_H_
