// The state of the search index as a whole.
#ifndef ARGMESH_SERVER_ENGINE_INDEX_STATE_H_
#define ARGMESH_SERVER_ENGINE_INDEX_STATE_H_

namespace argmesh {

enum class IndexState { kLoading, kServing, kClosed };

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_INDEX_STATE_H_
