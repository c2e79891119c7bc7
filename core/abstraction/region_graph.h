// The connected regions of a labelling and how strongly they hang together.
//
// Regions are the connected components of equal label over the links of a
// graph; the smallest ones are absorbed into the neighbour they share the
// strongest border with.
//
// Repeats  equal input gives bit-equal output; regions are numbered by falling
//          area, ties by first sample.
// Cost     O(n log n + regions^2). Thread-safe.
#ifndef ARGMESH_CORE_ABSTRACTION_REGION_GRAPH_H_
#define ARGMESH_CORE_ABSTRACTION_REGION_GRAPH_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/surface_graph.h"

namespace argmesh {

struct RegionOptions {
  double min_area = 0.003;  // share of the surface; 0 absorbs nothing
  int max_regions = 96;     // >= 1
};

struct RegionGraph {
  std::vector<int32_t> region_of_sample;
  Eigen::VectorXd areas;    // shares, sum 1
  Eigen::MatrixXd borders;  // symmetric: sum of link weight * link length

  int num_regions() const { return static_cast<int>(areas.size()); }
};

// `link_weights` is aligned with graph.targets.
RegionGraph BuildRegionGraph(const SurfaceGraph& graph,
                             const Eigen::VectorXd& areas,
                             std::span<const double> link_weights,
                             std::span<const int32_t> label_of_sample,
                             const RegionOptions& options);

}  // namespace argmesh

#endif  // ARGMESH_CORE_ABSTRACTION_REGION_GRAPH_H_
