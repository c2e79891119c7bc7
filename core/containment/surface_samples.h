// Points spread evenly over a surface, and its open boundary.
#ifndef ARGMESH_CORE_CONTAINMENT_SURFACE_SAMPLES_H_
#define ARGMESH_CORE_CONTAINMENT_SURFACE_SAMPLES_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/containment/window_set.h"
#include "core/geometry/point_tree.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct SurfaceSamples {
  // Any head of these is spread over the whole surface.
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;  // unit
  std::vector<int32_t> faces;            // that each lies on
};

// The mesh with its area centroid in the origin and area 1. `areas` are those
// of its faces, of positive sum.
TriangleMesh ToUnitArea(const TriangleMesh& mesh, const Eigen::VectorXd& areas,
                        WindowFrame& frame);

// `count` points, each for an equal share of the area: stratified along the
// list of faces, then shuffled. A normal is the face's plus the interpolated
// normal of its corners.
//
// Repeats  equal input gives bit-equal output. Cost O(m + count).
SurfaceSamples SampleSurface(const TriangleMesh& mesh,
                             const Eigen::VectorXd& areas, int count,
                             uint64_t seed);

// The open boundary in pieces. Edges at which a repair split a surface that
// goes on (two boundary edges between equal positions) are not open.
struct OpenBoundary {
  std::vector<Eigen::Vector3f> points;  // about 0.01 apart
  std::vector<float> extent;  // of the piece a point is of: its box's diagonal
};

// Cost O(m log m).
OpenBoundary FindOpenBoundary(const TriangleMesh& mesh);

// The boundary that matters to windows of `radius`: pieces smaller than a
// quarter of it are pinholes.
PointTree BoundaryForRadius(const OpenBoundary& boundary, float radius);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_SURFACE_SAMPLES_H_
