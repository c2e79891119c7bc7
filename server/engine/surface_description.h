// What is kept of a shape beside its graph: its signature for global searches,
// its windows for partial ones.
#ifndef ARGMESH_SERVER_ENGINE_SURFACE_DESCRIPTION_H_
#define ARGMESH_SERVER_ENGINE_SURFACE_DESCRIPTION_H_

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/containment/window_words.h"
#include "core/mesh/triangle_mesh.h"
#include "core/signature/shape_signature.h"
#include "server/engine/catalog_requests.h"

namespace argmesh {

struct SurfaceDescription {
  ShapeSignature signature;
  WindowWords words;
  SurfaceDescriptors bytes;  // of both, and the windows themselves
};

// Of a mesh after repair (ComputedGraph::repaired).
//
// Fails    kFailedPrecondition  no face of positive area
//          kCancelled, kDeadlineExceeded
// Cost     about 0.25 s
absl::StatusOr<SurfaceDescription> DescribeSurface(const TriangleMesh& repaired,
                                                   const StopToken& stop);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SURFACE_DESCRIPTION_H_
