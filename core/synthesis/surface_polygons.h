// An implicit surface as a closed triangle mesh.
//
// Dual marching cubes: one vertex for every sheet of surface in a grid cell,
// one polygon around every grid edge the surface crosses, then a few rounds of
// evening out along the surface. The cell size follows from the surface's
// area, so thin shapes get small cells.
//
// Source   Nielson, "Dual Marching Cubes", IEEE Visualization 2004; Gibson,
//          "Constrained Elastic Surface Nets", MICCAI 1998.
// Output   closed oriented 2-manifold, every vertex used; where cells hold
//          two touching faces a vertex on that face keeps the sheets apart.
// Repeats  equal surface and options give bit-equal output.
// Fails    kInvalidArgument     target_vertices outside its range
//          kFailedPrecondition  the surface is empty
// Cost     about 10 ms for 5,000 vertices. Thread-safe.
#ifndef ARGMESH_CORE_SYNTHESIS_SURFACE_POLYGONS_H_
#define ARGMESH_CORE_SYNTHESIS_SURFACE_POLYGONS_H_

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mesh/triangle_mesh.h"
#include "core/synthesis/implicit_surface.h"

namespace argmesh {

struct PolygonizeOptions {
  int target_vertices = 4500;  // 100 .. 200,000, met within about a quarter
  int relax_rounds = 2;        // 0 .. 20
};

struct PolygonizedSurface {
  TriangleMesh mesh;
  std::vector<int32_t> part_of_face;  // numbers into surface.part_names()
};

absl::StatusOr<PolygonizedSurface> PolygonizeSurface(
    const ImplicitSurface& surface, const PolygonizeOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_SURFACE_POLYGONS_H_
