// Connectivity of an oriented 2-manifold with boundary as half-edges, with the
// one operation that simplification needs. Positions stay with the caller.
//
// Not thread-safe; const methods are.
#ifndef ARGMESH_CORE_MESH_HALFEDGE_MESH_H_
#define ARGMESH_CORE_MESH_HALFEDGE_MESH_H_

#include <cstdint>
#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

class HalfedgeMesh {
 public:
  // kFailedPrecondition where the faces are no oriented manifold or a vertex
  // is unused; names the face or vertex.
  static absl::StatusOr<HalfedgeMesh> Create(const FaceMatrix& F,
                                             int num_vertices);
  HalfedgeMesh(HalfedgeMesh&&) noexcept;
  HalfedgeMesh& operator=(HalfedgeMesh&&) noexcept;
  ~HalfedgeMesh();

  bool IsAlive(int32_t v) const;
  bool IsBoundary(int32_t v) const;

  // The neighbours of v, clockwise. Neighbours next to each other share a face
  // with v; so do the last and the first unless v is on the boundary.
  void GetRing(int32_t v, std::vector<int32_t>& ring) const;

  // Whether moving all faces of `from` to `to` leaves a manifold of the same
  // topology in which the component still has a face.
  bool CanCollapse(int32_t from, int32_t to) const;

  // Removes `from`; CanCollapse(from, to) must hold.
  void Collapse(int32_t from, int32_t to);

  // The faces left, in their first order, over the original vertex numbers.
  FaceMatrix CopyFaces() const;

 private:
  struct Kernel;
  explicit HalfedgeMesh(std::unique_ptr<Kernel> kernel);

  std::unique_ptr<Kernel> kernel_;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_HALFEDGE_MESH_H_
