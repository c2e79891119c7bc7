// The polygons dual to a grid's cells: one around each grid edge that the
// surface crosses, before they become triangles.
//
// Cost     O(crossed edges). Repeats: vertices in order of the grid's blocks.
#ifndef ARGMESH_CORE_SYNTHESIS_DUAL_POLYGONS_H_
#define ARGMESH_CORE_SYNTHESIS_DUAL_POLYGONS_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/synthesis/surface_grid.h"

namespace argmesh {

struct DualPolygons {
  std::vector<Eigen::Vector3d> positions;
  std::vector<GridCorner> cells;       // the cell of each vertex
  std::vector<int32_t> offsets = {0};  // polygon i: corners[offsets[i]] ...
  std::vector<int32_t> corners;        // counter-clockwise from outside

  int num_polygons() const { return static_cast<int>(offsets.size()) - 1; }
};

DualPolygons BuildDualPolygons(const SurfaceGrid& grid);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_DUAL_POLYGONS_H_
