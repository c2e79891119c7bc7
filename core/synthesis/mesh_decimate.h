// Fewer triangles for the same surface, by collapsing the cheapest edges.
//
// Independent of core/mesh's resampling, so that one can test the other.
//
// Source   Garland, Heckbert, "Surface Simplification Using Quadric Error
//          Metrics", SIGGRAPH 1997; link condition of Dey et al. 1999.
// Input    2-manifold, closed or with boundary; boundary vertices stay.
// Output   manifold of the same topology; vertices used by no face are gone.
// Repeats  equal input gives bit-equal output.
// Cost     O(m log m), about 60 ms from 10,000 vertices to 2,000.
#ifndef ARGMESH_CORE_SYNTHESIS_MESH_DECIMATE_H_
#define ARGMESH_CORE_SYNTHESIS_MESH_DECIMATE_H_

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// Ends with `target_vertices` vertices, or more when no edge is left that can
// go without changing topology or flipping a face.
TriangleMesh DecimateMesh(const TriangleMesh& mesh, int target_vertices);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_MESH_DECIMATE_H_
