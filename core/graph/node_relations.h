// How the nodes of a level lie to each other: average geodesic distances and
// the edges between neighbours.
#ifndef ARGMESH_CORE_GRAPH_NODE_RELATIONS_H_
#define ARGMESH_CORE_GRAPH_NODE_RELATIONS_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/geometry/geodesic.h"
#include "core/geometry/surface_graph.h"
#include "core/graph/node_attributes.h"
#include "core/graph/shape_graph.h"

namespace argmesh {

// k x k, symmetric: the distance from the centre of one node to the samples of
// the other, averaged by area and over both directions. Cost k Dijkstras.
absl::StatusOr<Eigen::MatrixXd> AverageGeodesicDistances(
    const NodeMembers& members, std::span<const int32_t> node_of_sample,
    const Eigen::VectorXd& areas, GeodesicSolver& solver,
    const StopToken& stop);

// The same for groups of nodes: means over their pairs, weighted by area.
Eigen::MatrixXd GroupDistances(const Eigen::MatrixXd& distances,
                               std::span<const double> areas,
                               std::span<const int32_t> group_of_node,
                               int num_groups);

// The pairs i < j, row after row, as ArgLevel::distances.
std::vector<float> PackDistances(const Eigen::MatrixXd& distances);

// Nodes joined by a mesh edge or a bridge, sorted by (a, b). A border is half
// the length of the mesh edges across it: they zigzag over it about twice.
std::vector<ArgEdge> FindEdges(const SurfaceGraph& edge_graph,
                               std::span<const int32_t> node_of_sample,
                               const Eigen::MatrixXd& distances);

}  // namespace argmesh

#endif  // ARGMESH_CORE_GRAPH_NODE_RELATIONS_H_
