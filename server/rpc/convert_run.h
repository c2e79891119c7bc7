// Reports of runs over many items to collection_service.proto and
// ingest_service.proto.
#ifndef ARGMESH_SERVER_RPC_CONVERT_RUN_H_
#define ARGMESH_SERVER_RPC_CONVERT_RUN_H_

#include <string_view>

#include "argmesh/v1/collection_service.pb.h"
#include "argmesh/v1/ingest_service.pb.h"
#include "server/engine/item_run.h"

namespace argmesh {

// Items are ids of shapes of `collection`.
v1::ReindexCollectionResponse ReindexAnswer(std::string_view collection,
                                            const RunReport& report);
// Items are paths of files.
v1::ImportShapesResponse ImportAnswer(const RunReport& report);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_RUN_H_
