// Small surfaces of known shape, built in code.
#ifndef ARGMESH_TESTS_SUPPORT_TEST_MESHES_H_
#define ARGMESH_TESTS_SUPPORT_TEST_MESHES_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// A closed surface around the z axis through (z, radius) points of radius > 0;
// the poles lie at the first and the last z. Normals point outwards.
TriangleMesh MakeRevolution(const std::vector<Eigen::Vector2d>& profile,
                            int segments);

// Two balls of radius 1 joined by a thin neck along z, total length about 6.
TriangleMesh MakeDumbbell(int segments = 48);

// Radii R > r around the z axis; genus 1.
TriangleMesh MakeTorus(double major_radius, double minor_radius, int major,
                       int minor);

// An open square sheet of n x n cells in the xy plane, side 1.
TriangleMesh MakeSheet(int n);

// The faces of both; the second one's vertices after the first one's.
TriangleMesh Join(const TriangleMesh& a, const TriangleMesh& b);

TriangleMesh Translated(TriangleMesh mesh, const Eigen::Vector3d& by);

// A seeded rotation, scaling by 0.2 .. 5 and translation, with vertices and
// faces renumbered.
TriangleMesh RandomlyMoved(const TriangleMesh& mesh, uint64_t seed);

// Of all faces.
double Area(const TriangleMesh& mesh);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_TEST_MESHES_H_
