#include "core/abstraction/region_graph.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace argmesh {
namespace {

struct Regions {
  std::vector<int32_t> of_sample;
  std::vector<double> areas;
  std::vector<std::map<int32_t, double>> borders;
};

int32_t FloodRegion(const SurfaceGraph& graph, std::span<const int32_t> labels,
                    int start, int32_t id, std::vector<int32_t>& of_sample) {
  int32_t size = 0;
  std::vector<int32_t> stack = {start};
  of_sample[static_cast<size_t>(start)] = id;
  while (!stack.empty()) {
    const auto v = static_cast<size_t>(stack.back());
    stack.pop_back();
    ++size;
    for (int32_t link = graph.offsets[v]; link < graph.offsets[v + 1]; ++link) {
      const int32_t u = graph.targets[static_cast<size_t>(link)];
      int32_t& region = of_sample[static_cast<size_t>(u)];
      if (region >= 0 || labels[static_cast<size_t>(u)] != labels[v]) continue;
      region = id;
      stack.push_back(u);
    }
  }
  return size;
}

Regions FindConnectedRegions(const SurfaceGraph& graph,
                             const Eigen::VectorXd& areas,
                             std::span<const double> link_weights,
                             std::span<const int32_t> labels) {
  Regions regions;
  regions.of_sample.assign(labels.size(), -1);
  int32_t count = 0;
  for (int v = 0; v < graph.num_vertices(); ++v) {
    if (regions.of_sample[static_cast<size_t>(v)] >= 0) continue;
    FloodRegion(graph, labels, v, count++, regions.of_sample);
  }
  regions.areas.assign(static_cast<size_t>(count), 0);
  regions.borders.resize(static_cast<size_t>(count));
  for (size_t v = 0; v < labels.size(); ++v) {
    const int32_t a = regions.of_sample[v];
    regions.areas[static_cast<size_t>(a)] +=
        areas[static_cast<Eigen::Index>(v)];
    for (auto link = static_cast<size_t>(graph.offsets[v]);
         link < static_cast<size_t>(graph.offsets[v + 1]); ++link) {
      const int32_t b =
          regions.of_sample[static_cast<size_t>(graph.targets[link])];
      if (a == b) continue;
      regions.borders[static_cast<size_t>(a)][b] +=
          link_weights[link] * static_cast<double>(graph.lengths[link]);
    }
  }
  return regions;
}

// Absorbs smallest first; returns for every region the one it ended in.
class Absorber {
 public:
  explicit Absorber(Regions& regions) : regions_(regions) {
    into_.resize(regions.areas.size());
    std::iota(into_.begin(), into_.end(), 0);
    for (size_t r = 0; r < regions.areas.size(); ++r) {
      queue_.insert({regions.areas[r], static_cast<int32_t>(r)});
    }
  }

  std::vector<int32_t> Run(const RegionOptions& options) {
    size_t live = queue_.size();
    while (queue_.size() > 1) {
      const auto [area, smallest] = *queue_.begin();
      if (area >= options.min_area &&
          live <= static_cast<size_t>(options.max_regions)) {
        break;
      }
      queue_.erase(queue_.begin());
      const int32_t target = StrongestNeighbour(smallest);
      if (target < 0) continue;  // nothing touches it: it stays
      queue_.erase({regions_.areas[static_cast<size_t>(target)], target});
      Merge(smallest, target);
      queue_.insert({regions_.areas[static_cast<size_t>(target)], target});
      --live;
    }
    for (size_t r = 0; r < into_.size(); ++r) {
      int32_t root = into_[r];
      while (into_[static_cast<size_t>(root)] != root) {
        root = into_[static_cast<size_t>(root)];
      }
      into_[r] = root;
    }
    return into_;
  }

 private:
  int32_t StrongestNeighbour(int32_t region) const {
    int32_t strongest = -1;
    double best = -1;
    for (const auto& [other, weight] :
         regions_.borders[static_cast<size_t>(region)]) {
      if (weight > best) {
        best = weight;
        strongest = other;
      }
    }
    return strongest;
  }

  void Merge(int32_t region, int32_t target) {
    into_[static_cast<size_t>(region)] = target;
    regions_.areas[static_cast<size_t>(target)] +=
        regions_.areas[static_cast<size_t>(region)];
    auto& target_borders = regions_.borders[static_cast<size_t>(target)];
    for (const auto& [other, weight] :
         regions_.borders[static_cast<size_t>(region)]) {
      auto& other_borders = regions_.borders[static_cast<size_t>(other)];
      other_borders.erase(region);
      if (other == target) continue;
      target_borders[other] += weight;
      other_borders[target] += weight;
    }
    target_borders.erase(region);
  }

  Regions& regions_;
  std::vector<int32_t> into_;
  std::set<std::pair<double, int32_t>> queue_;
};

}  // namespace

RegionGraph BuildRegionGraph(const SurfaceGraph& graph,
                             const Eigen::VectorXd& areas,
                             std::span<const double> link_weights,
                             std::span<const int32_t> label_of_sample,
                             const RegionOptions& options) {
  Regions regions =
      FindConnectedRegions(graph, areas, link_weights, label_of_sample);
  const std::vector<int32_t> root = Absorber(regions).Run(options);

  std::vector<int32_t> kept;
  for (size_t r = 0; r < root.size(); ++r) {
    if (root[r] == static_cast<int32_t>(r)) kept.push_back(root[r]);
  }
  std::stable_sort(kept.begin(), kept.end(), [&](int32_t a, int32_t b) {
    return regions.areas[static_cast<size_t>(a)] >
           regions.areas[static_cast<size_t>(b)];
  });
  std::vector<int32_t> number(root.size(), -1);
  for (size_t k = 0; k < kept.size(); ++k) {
    number[static_cast<size_t>(kept[k])] = static_cast<int32_t>(k);
  }
  RegionGraph result;
  result.region_of_sample.reserve(label_of_sample.size());
  for (const int32_t region : regions.of_sample) {
    result.region_of_sample.push_back(
        number[static_cast<size_t>(root[static_cast<size_t>(region)])]);
  }
  const auto count = static_cast<Eigen::Index>(kept.size());
  result.areas.resize(count);
  result.borders = Eigen::MatrixXd::Zero(count, count);
  for (size_t k = 0; k < kept.size(); ++k) {
    const auto row = static_cast<size_t>(kept[k]);
    result.areas[static_cast<Eigen::Index>(k)] = regions.areas[row];
    for (const auto& [other, weight] : regions.borders[row]) {
      result.borders(static_cast<Eigen::Index>(k),
                     number[static_cast<size_t>(other)]) = weight;
    }
  }
  return result;
}

}  // namespace argmesh
