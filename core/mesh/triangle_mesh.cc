#include "core/mesh/triangle_mesh.h"

#include "absl/strings/str_format.h"

namespace argmesh {

absl::Status CheckMesh(const TriangleMesh& mesh) {
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    if (!mesh.V.row(v).allFinite()) {
      return absl::InvalidArgumentError(
          absl::StrFormat("vertex %d: coordinates (%g, %g, %g) are not finite",
                          v, mesh.V(v, 0), mesh.V(v, 1), mesh.V(v, 2)));
    }
  }
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      const int32_t v = mesh.F(f, corner);
      if (v < 0 || v >= mesh.num_vertices()) {
        return absl::InvalidArgumentError(absl::StrFormat(
            "face %d: vertex %d of %d", f, v, mesh.num_vertices()));
      }
    }
  }
  return absl::OkStatus();
}

Adjacency ComputeVertexFaces(const TriangleMesh& mesh) {
  Adjacency adjacency;
  adjacency.offsets.assign(static_cast<size_t>(mesh.num_vertices()) + 1, 0);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      ++adjacency.offsets[static_cast<size_t>(mesh.F(f, corner)) + 1];
    }
  }
  for (size_t v = 1; v < adjacency.offsets.size(); ++v) {
    adjacency.offsets[v] += adjacency.offsets[v - 1];
  }
  adjacency.items.resize(static_cast<size_t>(adjacency.offsets.back()));
  std::vector<int32_t> next = adjacency.offsets;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      int32_t& slot = next[static_cast<size_t>(mesh.F(f, corner))];
      adjacency.items[static_cast<size_t>(slot++)] = f;
    }
  }
  return adjacency;
}

std::vector<int32_t> RemoveUnusedVertices(TriangleMesh& mesh) {
  std::vector<int32_t> new_index(static_cast<size_t>(mesh.num_vertices()), -1);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      new_index[static_cast<size_t>(mesh.F(f, corner))] = 0;
    }
  }
  std::vector<int32_t> kept;
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    int32_t& index = new_index[static_cast<size_t>(v)];
    if (index < 0) continue;
    index = static_cast<int32_t>(kept.size());
    mesh.V.row(index) = mesh.V.row(v);
    kept.push_back(v);
  }
  mesh.V.conservativeResize(static_cast<Eigen::Index>(kept.size()), 3);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      int32_t& v = mesh.F(f, corner);
      v = new_index[static_cast<size_t>(v)];
    }
  }
  return kept;
}

}  // namespace argmesh
