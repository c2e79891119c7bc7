// How easily a walk along the surface crosses each link: cotangent weights,
// lowered at concave creases and where the thickness jumps, which is where
// people see the borders of parts.
//
// Source   docs/algorithm.md; the minima rule of Hoffman, Richards, "Parts of
//          Recognition", Cognition 18, 1984.
// Output   one conductance > 0 per link of `graph`, symmetric.
// Cost     O(links). Thread-safe.
#ifndef ARGMESH_CORE_ABSTRACTION_CONDUCTANCE_H_
#define ARGMESH_CORE_ABSTRACTION_CONDUCTANCE_H_

#include <vector>

#include "core/abstraction/decomposition.h"
#include "core/abstraction/surface_features.h"
#include "core/geometry/surface_graph.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

std::vector<double> ComputeConductances(const TriangleMesh& samples,
                                        const SurfaceFeatures& features,
                                        const SurfaceGraph& graph,
                                        const BiharmonicOptions& options);

}  // namespace argmesh

#endif  // ARGMESH_CORE_ABSTRACTION_CONDUCTANCE_H_
