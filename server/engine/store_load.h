// How much is stored and how busy the store is, for whoever watches it.
#ifndef ARGMESH_SERVER_ENGINE_STORE_LOAD_H_
#define ARGMESH_SERVER_ENGINE_STORE_LOAD_H_

#include <cstdint>

namespace argmesh {

// What a store cannot tell is 0.
struct StoreLoad {
  int64_t database_bytes = 0;
  int64_t wal_bytes = 0;
  int64_t meshes = 0;  // files that rows name
  int64_t mesh_bytes = 0;
  int64_t deleted_shapes = 0;  // of deleted collections, not removed yet
  int64_t free_bytes = 0;      // of the disk
  bool writable = true;        // false: writes that add are refused, disk full
  int64_t queued_writes = 0;   // wait for a commit
  int64_t commits = 0;         // since the start
  int64_t changes = 0;         // in these commits
  double commit_seconds = 0;   // that they took
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_STORE_LOAD_H_
