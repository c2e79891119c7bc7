// Reports of runs over many items to collection_service.proto and
// ingest_service.proto.
#ifndef ARGMESH_SERVER_RPC_CONVERT_RUN_H_
#define ARGMESH_SERVER_RPC_CONVERT_RUN_H_

#include "argmesh/v1/collection_service.pb.h"
#include "argmesh/v1/ingest_service.pb.h"
#include "server/engine/item_run.h"
#include "server/engine/reindex_report.h"

namespace argmesh {

v1::ReindexCollectionResponse ReindexAnswer(const ReindexReport& report);
// Items are paths of files.
v1::ImportShapesResponse ImportAnswer(const RunReport& report);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_RUN_H_
