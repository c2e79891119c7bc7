// An abstracted sphere of area 1 whose features are known in closed form.
#ifndef ARGMESH_TESTS_UNIT_CORE_GRAPH_SPHERE_SURFACE_H_
#define ARGMESH_TESTS_UNIT_CORE_GRAPH_SPHERE_SURFACE_H_

#include "core/abstraction/surface_abstraction.h"

namespace argmesh {

// Of the sphere of area 1.
inline constexpr double kSphereRadius = 0.28209479177387814;

// Regions are the 8 octants: region 4 (z < 0) + 2 (y < 0) + (x < 0). Levels:
// two hemispheres by z (threshold 1.6), then the octants (count 16). Uniform
// cells: 4 quadrants of (x, y). One mode, at the upper pole, of region 5. Five
// faces of the input: at the upper pole, but face 1 dropped and face 2 at the
// lower one.
SurfaceAbstraction MakeSphereSurface(int subdivisions);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_UNIT_CORE_GRAPH_SPHERE_SURFACE_H_
