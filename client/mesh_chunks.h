// A file in the pieces that a stream carries.
#ifndef ARGMESH_CLIENT_MESH_CHUNKS_H_
#define ARGMESH_CLIENT_MESH_CHUNKS_H_

#include <cstddef>
#include <string_view>

namespace argmesh {

inline constexpr size_t kMeshChunkBytes = size_t{256} * 1024;

// Calls `write` with each piece in turn until it returns false; false then.
template <typename Write>
bool ForEachChunk(std::string_view bytes, const Write& write) {
  for (size_t at = 0; at < bytes.size(); at += kMeshChunkBytes) {
    if (!write(bytes.substr(at, kMeshChunkBytes))) return false;
  }
  return true;
}

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_MESH_CHUNKS_H_
