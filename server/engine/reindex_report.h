// What came of reindexing a collection.
#ifndef ARGMESH_SERVER_ENGINE_REINDEX_REPORT_H_
#define ARGMESH_SERVER_ENGINE_REINDEX_REPORT_H_

#include "server/engine/collection_record.h"
#include "server/engine/item_run.h"

namespace argmesh {

struct ReindexReport {
  RunReport run;                // of all its rounds
  CollectionRecord collection;  // as it is afterwards
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_REINDEX_REPORT_H_
