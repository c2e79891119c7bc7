// Farthest-point geodesic Voronoi cells, as a decomposition of its own (the
// control without mean shift) and as cells of equal size beside components.
#ifndef ARGMESH_CORE_ABSTRACTION_VORONOI_REGIONS_H_
#define ARGMESH_CORE_ABSTRACTION_VORONOI_REGIONS_H_

#include "core/abstraction/decomposition.h"
#include "core/geometry/geodesic.h"

namespace argmesh {

// Nested levels of 4, 8, 16, .. cells: a finer cell belongs to the coarser
// cell its seed lies in. Levels are those of options.level_counts up to
// options.voronoi_cells. Cost O(cells * n log n).
Decomposition DecomposeByVoronoi(const DecompositionInput& input,
                                 const DecompositionOptions& options);

// The first sample that is about as far from the origin as any.
int FarthestFromOrigin(const TriangleMesh& samples);

// `count` cells started from the sample farthest from the centroid.
FarthestPointCells ComputeUniformCells(const TriangleMesh& samples,
                                       const SurfaceGraph& geodesic_graph,
                                       int count);

}  // namespace argmesh

#endif  // ARGMESH_CORE_ABSTRACTION_VORONOI_REGIONS_H_
