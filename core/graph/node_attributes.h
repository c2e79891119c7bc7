// The attributes of the nodes of one level: the paper's tuple V_c (eq. 4) and
// soft histograms of what its samples carry.
#ifndef ARGMESH_CORE_GRAPH_NODE_ATTRIBUTES_H_
#define ARGMESH_CORE_GRAPH_NODE_ATTRIBUTES_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/abstraction/surface_abstraction.h"
#include "core/geometry/geodesic.h"
#include "core/graph/shape_graph.h"

namespace argmesh {

// Areas below this count as this: keeps the attributes of a degenerate node
// finite.
inline constexpr double kMinNodeArea = 1e-9;

// The samples of each node, in sample order: members of node c are
// samples[offsets[c] .. offsets[c+1]).
struct NodeMembers {
  std::vector<int32_t> offsets;
  std::vector<int32_t> samples;
  std::vector<double> area;             // of each node, >= kMinNodeArea
  std::vector<Eigen::Vector3d> center;  // area centroid
  std::vector<int32_t> center_sample;   // member nearest to it, ties by index

  int num_nodes() const { return static_cast<int>(area.size()); }
  std::span<const int32_t> Of(int node) const;
};

// `node_of_sample` in 0 .. num_nodes-1, every node with a sample.
NodeMembers CollectMembers(const SurfaceAbstraction& surface,
                           std::span<const int32_t> node_of_sample,
                           int num_nodes);

// Area-stratified choice of at most `count` of `samples`, in their order: the
// samples at the middles of `count` equal shares of their area.
std::vector<int32_t> StratifiedSamples(std::span<const int32_t> samples,
                                       const Eigen::VectorXd& areas, int count);

// What the histograms need of every sample, once for all levels.
struct SampleTerms {
  explicit SampleTerms(const SurfaceAbstraction& surface);

  std::vector<double> log2_diameter;
  std::vector<double> shape_index;      // -1 .. 1, 1 on a convex sphere
  std::vector<double> log2_curvedness;  // of half the curvedness
  std::vector<int32_t> whole;  // 150 stratified samples of the whole shape
};

// All nodes of one level, without parents. Cost O(n + nodes * 64 * 214).
std::vector<ArgNode> ComputeNodeAttributes(
    const SurfaceAbstraction& surface, const SampleTerms& terms,
    const NodeMembers& members, std::span<const int32_t> node_of_sample,
    GeodesicSolver& solver);

}  // namespace argmesh

#endif  // ARGMESH_CORE_GRAPH_NODE_ATTRIBUTES_H_
