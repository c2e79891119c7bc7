// The faces of a target that a query lies on, for pictures and reports.
//
// Cost     O(m log n). Thread-safe.
#ifndef ARGMESH_CORE_CONTAINMENT_COVERED_FACES_H_
#define ARGMESH_CORE_CONTAINMENT_COVERED_FACES_H_

#include <vector>

#include "core/containment/containment_match.h"
#include "core/containment/window_set.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// By face of `mesh`, the target in its own units: whether its centroid lies
// within 3 % of the query's size of the query's surface.
std::vector<bool> CoveredFaces(const QueryWindows& query,
                               const ContainmentMatch& match,
                               const TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_COVERED_FACES_H_
