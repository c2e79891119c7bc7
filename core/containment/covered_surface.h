// Where on a target a query lies, for pictures and reports.
//
// Covered is what lies within 3 % of the query's size of its surface, facing
// the same way. Of a match without a transform, nothing is.
//
// Cost     O((n + m) log n) for n query points. Thread-safe.
#ifndef ARGMESH_CORE_CONTAINMENT_COVERED_SURFACE_H_
#define ARGMESH_CORE_CONTAINMENT_COVERED_SURFACE_H_

#include <vector>

#include "core/containment/containment_match.h"
#include "core/containment/window_set.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// By face of `mesh`, the target in its own units, by its centroid. Faces of an
// inside-out mesh count as facing the other way.
std::vector<bool> CoveredFaces(const QueryWindows& query,
                               const ContainmentMatch& match,
                               const TriangleMesh& mesh);

// By sample point of the target.
std::vector<bool> CoveredPoints(const QueryWindows& query,
                                const ContainmentMatch& match,
                                const TargetWindows& target);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_COVERED_SURFACE_H_
