#include "core/mesh/halfedge_mesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/mesh/mesh_edges.h"

namespace argmesh {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// Only what collapsing needs: no normals, colours or texture coordinates.
struct ConnectivityTraits : OpenMesh::DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge |
                     OpenMesh::Attributes::Status);
};

}  // namespace

struct HalfedgeMesh::Kernel {
  // is_collapse_ok marks vertices, so it is no const method there.
  mutable OpenMesh::TriMesh_ArrayKernelT<ConnectivityTraits> mesh;
};

HalfedgeMesh::HalfedgeMesh(std::unique_ptr<Kernel> kernel)
    : kernel_(std::move(kernel)) {}
HalfedgeMesh::HalfedgeMesh(HalfedgeMesh&&) noexcept = default;
HalfedgeMesh& HalfedgeMesh::operator=(HalfedgeMesh&&) noexcept = default;
HalfedgeMesh::~HalfedgeMesh() = default;

absl::StatusOr<HalfedgeMesh> HalfedgeMesh::Create(const FaceMatrix& F,
                                                  int num_vertices) {
  // add_face writes to the standard error besides failing.
  static const bool silent = [] {
    omerr().disable();
    return true;
  }();
  static_cast<void>(silent);
  auto kernel = std::make_unique<Kernel>();
  auto& mesh = kernel->mesh;
  const size_t num_faces = static_cast<size_t>(F.rows());
  mesh.reserve(Slot(num_vertices), num_faces * 3 / 2 + Slot(num_vertices),
               num_faces);
  for (int v = 0; v < num_vertices; ++v) mesh.new_vertex();
  for (Eigen::Index f = 0; f < F.rows(); ++f) {
    const FaceHandle face = mesh.add_face(
        VertexHandle(F(f, 0)), VertexHandle(F(f, 1)), VertexHandle(F(f, 2)));
    if (!face.is_valid()) {
      return absl::FailedPreconditionError(absl::StrFormat(
          "face %d (%d, %d, %d) makes the surface non-manifold or is not "
          "oriented like its neighbours",
          f, F(f, 0), F(f, 1), F(f, 2)));
    }
  }
  for (int v = 0; v < num_vertices; ++v) {
    if (mesh.is_isolated(VertexHandle(v))) {
      return absl::FailedPreconditionError(
          absl::StrFormat("vertex %d has no face", v));
    }
  }
  return HalfedgeMesh(std::move(kernel));
}

bool HalfedgeMesh::IsAlive(int32_t v) const {
  return !kernel_->mesh.status(VertexHandle(v)).deleted();
}

bool HalfedgeMesh::IsBoundary(int32_t v) const {
  return kernel_->mesh.is_boundary(VertexHandle(v));
}

void HalfedgeMesh::GetRing(int32_t v, std::vector<int32_t>& ring) const {
  const auto& mesh = kernel_->mesh;
  ring.clear();
  // A boundary vertex keeps its boundary half-edge as the outgoing one, so the
  // walk starts and ends at the gap.
  const HalfedgeHandle first = mesh.halfedge_handle(VertexHandle(v));
  HalfedgeHandle h = first;
  do {
    ring.push_back(mesh.to_vertex_handle(h).idx());
    h = mesh.next_halfedge_handle(mesh.opposite_halfedge_handle(h));
  } while (h != first);
}

bool HalfedgeMesh::CanCollapse(int32_t from, int32_t to) const {
  auto& mesh = kernel_->mesh;
  const VertexHandle a(from);
  const VertexHandle b(to);
  const HalfedgeHandle h = mesh.find_halfedge(a, b);
  if (!h.is_valid() || !mesh.is_collapse_ok(h)) return false;
  // OpenMesh would flatten a tetrahedron to two faces back to back.
  const bool edge_on_boundary =
      mesh.is_boundary(h) || mesh.is_boundary(mesh.opposite_halfedge_handle(h));
  const unsigned shared = edge_on_boundary ? 1 : 2;
  const unsigned valence = mesh.valence(a) + mesh.valence(b) - 2 - shared;
  const bool interior = !mesh.is_boundary(a) && !mesh.is_boundary(b);
  return valence >= (interior ? 3U : 2U);
}

void HalfedgeMesh::Collapse(int32_t from, int32_t to) {
  auto& mesh = kernel_->mesh;
  mesh.collapse(mesh.find_halfedge(VertexHandle(from), VertexHandle(to)));
}

FaceMatrix HalfedgeMesh::CopyFaces() const {
  const auto& mesh = kernel_->mesh;
  FaceMatrix F(static_cast<Eigen::Index>(mesh.n_faces()), 3);
  Eigen::Index rows = 0;
  for (const auto face : mesh.faces()) {
    HalfedgeHandle h = mesh.halfedge_handle(face);
    for (int c = 0; c < 3; ++c) {
      F(rows, c) = mesh.to_vertex_handle(h).idx();
      h = mesh.next_halfedge_handle(h);
    }
    ++rows;
  }
  F.conservativeResize(rows, 3);
  return F;
}

}  // namespace argmesh
