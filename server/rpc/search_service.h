// argmesh.v1.SearchService.
#ifndef ARGMESH_SERVER_RPC_SEARCH_SERVICE_H_
#define ARGMESH_SERVER_RPC_SEARCH_SERVICE_H_

#include "server/rpc/rpc_service.h"

namespace argmesh {

class SearchServiceImpl final : public RpcService {
 public:
  // `environment` must outlive the service.
  explicit SearchServiceImpl(ServiceEnvironment& environment);
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_SEARCH_SERVICE_H_
