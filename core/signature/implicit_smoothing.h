// Removes noise by one step of heat flow, long for its size and stable on any
// triangles.
//
// Solves (M + t A L) X = M X0 for the positions X: M the areas of vertices, A
// the whole area, L the Laplacian of cotangents. Details smaller than about
// sqrt(t A) go, larger ones stay.
//
// Source   Desbrun, Meyer, Schroeder, Barr, "Implicit Fairing of Irregular
//          Meshes using Diffusion and Curvature Flow", SIGGRAPH 1999.
#ifndef ARGMESH_CORE_SIGNATURE_IMPLICIT_SMOOTHING_H_
#define ARGMESH_CORE_SIGNATURE_IMPLICIT_SMOOTHING_H_

#include "absl/status/status.h"
#include "core/base/stop_token.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// Moves the vertices of `mesh`, of positive area; `edges` are its edges, `time`
// is t > 0. By conjugate gradients to a relative residual of 1e-4 or 200
// rounds.
//
// Repeats  equal input gives bit-equal output.
// Fails    kCancelled, kDeadlineExceeded
// Cost     O(m) a round; 10 to 30 rounds for 10,000 vertices.
absl::Status SmoothImplicitly(const MeshEdges& edges, double time,
                              const StopToken& stop, TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_IMPLICIT_SMOOTHING_H_
