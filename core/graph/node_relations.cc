#include "core/graph/node_relations.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/base/status_macros.h"

namespace argmesh {

absl::StatusOr<Eigen::MatrixXd> AverageGeodesicDistances(
    const NodeMembers& members, std::span<const int32_t> node_of_sample,
    const Eigen::VectorXd& areas, GeodesicSolver& solver,
    const StopToken& stop) {
  const int k = members.num_nodes();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(k, k);
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(k, k);
  for (int i = 0; i < k; ++i) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    const auto source = members.center_sample[static_cast<size_t>(i)];
    for (const ReachedVertex& r : solver.FindWithin(source)) {
      const int32_t j = node_of_sample[static_cast<size_t>(r.vertex)];
      // Nodes of samples without area still have a distance.
      const double a = std::max(areas[r.vertex], 1e-15);
      sum(i, j) += a * static_cast<double>(r.distance);
      weight(i, j) += a;
    }
  }
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(k, k);
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < k; ++j) {
      if (weight(i, j) > 0) mean(i, j) = sum(i, j) / weight(i, j);
    }
  }
  return Eigen::MatrixXd((mean + mean.transpose()) / 2);
}

Eigen::MatrixXd GroupDistances(const Eigen::MatrixXd& distances,
                               std::span<const double> areas,
                               std::span<const int32_t> group_of_node,
                               int num_groups) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(num_groups, num_groups);
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(num_groups, num_groups);
  for (size_t i = 0; i < group_of_node.size(); ++i) {
    for (size_t j = 0; j < group_of_node.size(); ++j) {
      const double w = areas[i] * areas[j];
      sum(group_of_node[i], group_of_node[j]) +=
          w *
          distances(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      weight(group_of_node[i], group_of_node[j]) += w;
    }
  }
  return sum.cwiseQuotient(weight.cwiseMax(1e-30));
}

std::vector<float> PackDistances(const Eigen::MatrixXd& distances) {
  std::vector<float> packed;
  const Eigen::Index k = distances.rows();
  packed.reserve(static_cast<size_t>(k * (k - 1) / 2));
  for (Eigen::Index i = 0; i < k; ++i) {
    for (Eigen::Index j = i + 1; j < k; ++j) {
      packed.push_back(static_cast<float>(distances(i, j)));
    }
  }
  return packed;
}

std::vector<ArgEdge> FindEdges(const SurfaceGraph& edge_graph,
                               std::span<const int32_t> node_of_sample,
                               const Eigen::MatrixXd& distances) {
  std::map<std::pair<int32_t, int32_t>, double> border;
  for (int v = 0; v < edge_graph.num_vertices(); ++v) {
    const int32_t a = node_of_sample[static_cast<size_t>(v)];
    const auto row = static_cast<size_t>(v);
    for (int32_t l = edge_graph.offsets[row]; l < edge_graph.offsets[row + 1];
         ++l) {
      const auto link = static_cast<size_t>(l);
      const int32_t b =
          node_of_sample[static_cast<size_t>(edge_graph.targets[link])];
      // Each link stands in both directions: one of them counts.
      if (a >= b || edge_graph.kinds[link] == LinkKind::kDiagonal) continue;
      double& length = border[{a, b}];
      if (edge_graph.kinds[link] == LinkKind::kEdge) {
        length += static_cast<double>(edge_graph.lengths[link]) / 2;
      }
    }
  }
  std::vector<ArgEdge> edges;
  edges.reserve(border.size());
  for (const auto& [pair, length] : border) {
    edges.push_back({pair.first, pair.second,
                     static_cast<float>(distances(pair.first, pair.second)),
                     static_cast<float>(length)});
  }
  return edges;
}

}  // namespace argmesh
