#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "core/graph/node_attributes.h"

namespace argmesh {

std::span<const int32_t> NodeMembers::Of(int node) const {
  const auto begin = static_cast<size_t>(offsets[static_cast<size_t>(node)]);
  const auto end = static_cast<size_t>(offsets[static_cast<size_t>(node) + 1]);
  return std::span(samples).subspan(begin, end - begin);
}

namespace {

void FindCenters(const SurfaceAbstraction& surface, NodeMembers& members) {
  const Eigen::VectorXd& areas = surface.features.areas;
  for (int c = 0; c < members.num_nodes(); ++c) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double area = 0;
    for (const int32_t v : members.Of(c)) {
      sum += areas[v] * surface.samples.vertex(v);
      area += areas[v];
    }
    // A node without area still has a place.
    const Eigen::Vector3d center =
        area > 0 ? Eigen::Vector3d(sum / area)
                 : surface.samples.vertex(members.Of(c).front());
    int32_t nearest = members.Of(c).front();
    double best = std::numeric_limits<double>::infinity();
    for (const int32_t v : members.Of(c)) {
      const double d = (surface.samples.vertex(v) - center).squaredNorm();
      if (d < best) {
        best = d;
        nearest = v;
      }
    }
    members.area[static_cast<size_t>(c)] = std::max(area, kMinNodeArea);
    members.center.push_back(center);
    members.center_sample.push_back(nearest);
  }
}

}  // namespace

NodeMembers CollectMembers(const SurfaceAbstraction& surface,
                           std::span<const int32_t> node_of_sample,
                           int num_nodes) {
  NodeMembers members;
  const auto k = static_cast<size_t>(num_nodes);
  members.offsets.assign(k + 1, 0);
  for (const int32_t c : node_of_sample) {
    ++members.offsets[static_cast<size_t>(c) + 1];
  }
  std::partial_sum(members.offsets.begin(), members.offsets.end(),
                   members.offsets.begin());
  members.samples.resize(node_of_sample.size());
  std::vector<int32_t> next(members.offsets.begin(), members.offsets.end() - 1);
  for (size_t v = 0; v < node_of_sample.size(); ++v) {
    const auto c = static_cast<size_t>(node_of_sample[v]);
    members.samples[static_cast<size_t>(next[c]++)] = static_cast<int32_t>(v);
  }
  members.area.assign(k, 0.0);
  FindCenters(surface, members);
  return members;
}

std::vector<int32_t> StratifiedSamples(std::span<const int32_t> samples,
                                       const Eigen::VectorXd& areas,
                                       int count) {
  std::vector<double> cumulative;
  cumulative.reserve(samples.size());
  double sum = 0;
  for (const int32_t v : samples) {
    sum += areas[v];
    cumulative.push_back(sum);
  }
  const auto chosen = std::min(samples.size(), static_cast<size_t>(count));
  std::vector<int32_t> strata;
  for (size_t t = 0; t < chosen; ++t) {
    const double at =
        sum * (static_cast<double>(t) + 0.5) / static_cast<double>(chosen);
    const auto found =
        std::lower_bound(cumulative.begin(), cumulative.end(), at);
    const auto index = static_cast<size_t>(found - cumulative.begin());
    strata.push_back(samples[std::min(index, samples.size() - 1)]);
  }
  return strata;
}

}  // namespace argmesh
