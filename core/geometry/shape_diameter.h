// Shape diameter: how thick the object is below each surface point.
//
// Rays in a cone around the inward normal; hits on the inner side of a face
// only; hits farther than one standard deviation from the median dropped;
// cosine-weighted mean. Vertices with fewer than 3 hits take the mean of their
// neighbours, or of all vertices when those have none either; a surface that
// no ray hits, such as a flat sheet, has 0.1 sqrt(area) everywhere. Smoothed
// over the graph three times.
//
// Source   Shapira, Shamir, Cohen-Or, "Consistent Mesh Partitioning and
//          Skeletonisation Using the Shape Diameter Function", Visual Computer
//          24, 2008.
// Input    an oriented mesh; `normals` unit and outward; any unit.
// Output   n lengths > 0.
// Repeats  equal input gives bit-equal output; nothing is random.
// Fails    kInvalidArgument     an option outside its range
//          kFailedPrecondition  no face of positive area
//          kInternal            the ray tracer could not be set up
// Cost     O(n rays log m). Thread-safe.
#ifndef ARGMESH_CORE_GEOMETRY_SHAPE_DIAMETER_H_
#define ARGMESH_CORE_GEOMETRY_SHAPE_DIAMETER_H_

#include <Eigen/Core>

#include "absl/status/statusor.h"
#include "core/geometry/surface_graph.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct ShapeDiameterOptions {
  int num_rays = 24;            // 3 .. 1000
  double cone_half_angle = 60;  // degrees, 1 .. 89
  int smoothing_steps = 3;      // >= 0
};

absl::StatusOr<Eigen::VectorXd> ComputeShapeDiameter(
    const TriangleMesh& mesh, const VertexMatrix& normals,
    const SurfaceGraph& graph, const ShapeDiameterOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_SHAPE_DIAMETER_H_
