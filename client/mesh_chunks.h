// A file in a message, or in the pieces that a stream carries.
#ifndef ARGMESH_CLIENT_MESH_CHUNKS_H_
#define ARGMESH_CLIENT_MESH_CHUNKS_H_

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace argmesh {

// Of a mesh in a message: the largest message less room for the rest.
inline constexpr int64_t kMaxInlineMeshBytes = (4 << 20) - (64 << 10);

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
