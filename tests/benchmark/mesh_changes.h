// What is done to meshes to see what it changes in their abstraction.
#ifndef ARGMESH_TESTS_BENCHMARK_MESH_CHANGES_H_
#define ARGMESH_TESTS_BENCHMARK_MESH_CHANGES_H_

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct MeshChange {
  std::string name;
  // The changed mesh; equal mesh and seed give bit-equal output.
  TriangleMesh (*apply)(const TriangleMesh& mesh, uint64_t seed);
  bool moves = false;  // by MotionOf(mesh, seed)
  bool cuts = false;   // the changed mesh is a part of the surface
};

// similar    a random similarity and other numbers for vertices and faces
// printed    the same, with coordinates of seven digits, as files hold them
// noise-0.5, noise-1  standard deviation .5 %, 1 % of the box diagonal
// decimated-25, decimated-10  per cent of the vertices that are kept
std::span<const MeshChange> WholeMeshChanges();

// half-x, half-y, half-z: halves of the bounding box.
std::span<const MeshChange> HalfMeshChanges();

// The similarity transform that a change with `moves` applies.
Eigen::Affine3d MotionOf(const TriangleMesh& mesh, uint64_t seed);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_BENCHMARK_MESH_CHANGES_H_
