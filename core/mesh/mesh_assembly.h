// Collects the vertices and polygons of a mesh file and makes the indexed
// triangle mesh of them.
//
// Polygons may come before the vertices they name. Corners are kept as they
// are until Finish, which allocates the triangles once, at their exact number.
//
// Fails    kResourceExhausted  over a limit; names value and limit
//          kInvalidArgument    no faces
// Cost     O(vertices + corners) and the triangulation's. One object belongs
//          to one thread.
#ifndef ARGMESH_CORE_MESH_MESH_ASSEMBLY_H_
#define ARGMESH_CORE_MESH_MESH_ASSEMBLY_H_

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/mesh/mesh_format.h"

namespace argmesh {

class MeshAssembly {
 public:
  // The work on non-convex polygons is bounded by a multiple of `file_bytes`.
  MeshAssembly(const MeshLimits& limits, size_t file_bytes);

  // Allowed by the limits, before anything of theirs is read.
  absl::Status CheckVertexCount(int64_t count) const;
  absl::Status CheckFaceCount(int64_t count) const;
  absl::Status CheckValence(int64_t valence) const;

  // `count` was checked against the bytes that are left.
  void ReserveVertices(int64_t count);
  absl::Status AddVertex(double x, double y, double z);
  int64_t num_vertices() const {
    return static_cast<int64_t>(coordinates_.size() / 3);
  }

  // One face of the file. Fewer than 3 corners: counted and left out. The
  // caller answers for the indices being vertices by the time of Finish.
  absl::Status AddPolygon(std::span<const int32_t> corners);
  // Triangles (0,1,2), (2,1,3), (2,3,4), ...: each is a face of the file.
  absl::Status AddStrip(std::span<const int32_t> corners);

  // Something of the file that is no part of a surface.
  void CountIgnoredStatements(int64_t count) { ignored_statements_ += count; }

  absl::StatusOr<ParsedMesh> Finish(MeshFormat format) &&;

 private:
  absl::Status AddTriangles(int64_t count);
  absl::Status FillFaces(ParsedMesh& parsed);

  MeshLimits limits_;
  int64_t max_tests_;
  std::vector<double> coordinates_;
  std::vector<int32_t> corners_;
  // By polygon or strip; a strip's is negative.
  std::vector<int32_t> valences_;
  int64_t num_triangles_ = 0;
  int64_t num_file_faces_ = 0;
  int64_t skipped_file_faces_ = 0;
  int64_t ignored_statements_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_ASSEMBLY_H_
