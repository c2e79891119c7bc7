// Meshes of surfaces whose areas, curvatures and distances are known exactly.
// All are oriented outwards and have no unused vertices.
#ifndef ARGMESH_TESTS_UNIT_CORE_GEOMETRY_CLOSED_FORM_MESHES_H_
#define ARGMESH_TESTS_UNIT_CORE_GEOMETRY_CLOSED_FORM_MESHES_H_

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// Icosahedron whose edges are cut into `frequency` parts:
// 10 * frequency^2 + 2 vertices.
TriangleMesh MakeIcosphere(int frequency, double radius);

// The same with every vertex moved along the sphere by up to a quarter of an
// edge: no symmetry is left.
TriangleMesh MakeIrregularSphere(int frequency, double radius, uint64_t seed);

// Torus around the z axis. Vertex (i, j) is number i * minor_steps + j.
TriangleMesh MakeTorus(double major_radius, double minor_radius,
                       int major_steps, int minor_steps);

// Cylinder side around the z axis, 0 <= z <= height. Vertex (ring, i) is
// number ring * around + i; with `staggered` every other ring is turned by
// half a step.
TriangleMesh MakeOpenCylinder(double radius, double height, int around,
                              int rings, bool staggered);

// Square [0, size]^2 at z = 0, normal +z. Vertex (i, j) at (i, j) * size /
// steps is number i * (steps + 1) + j. Diagonals alternate at random by `seed`.
TriangleMesh MakeGrid(double size, int steps, uint64_t seed);

// Closed box [0, x] x [0, y] x [0, z] with edges about `spacing` long.
TriangleMesh MakeBox(const Eigen::Vector3d& extent, double spacing);

// Both meshes as one; vertices of `b` follow those of `a`.
TriangleMesh Join(const TriangleMesh& a, const TriangleMesh& b);

TriangleMesh Moved(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation,
                   double scale, const Eigen::Vector3d& offset);

// Uniform by a seed.
Eigen::Matrix3d RandomRotation(uint64_t seed);

// Unit normals by a function of the position.
VertexMatrix NormalsBy(
    const TriangleMesh& mesh,
    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& normal);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_UNIT_CORE_GEOMETRY_CLOSED_FORM_MESHES_H_
