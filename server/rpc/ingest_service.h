// argmesh.v1.IngestService.
#ifndef ARGMESH_SERVER_RPC_INGEST_SERVICE_H_
#define ARGMESH_SERVER_RPC_INGEST_SERVICE_H_

#include "server/rpc/rpc_service.h"

namespace argmesh {

class IngestServiceImpl final : public RpcService {
 public:
  // `environment` must outlive the service.
  explicit IngestServiceImpl(ServiceEnvironment& environment);
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_INGEST_SERVICE_H_
