#include "core/geometry/component_tree.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

namespace argmesh {
namespace {

constexpr int32_t kComponentsPerLeaf = 8;

bool Nearer(const ComponentTree::Sample& a, const ComponentTree::Sample& b) {
  return std::tie(a.squared_distance, a.vertex) <
         std::tie(b.squared_distance, b.vertex);
}

}  // namespace

struct ComponentTree::Query {
  Eigen::Vector3d position;
  int32_t label;
  double max_squared_distance;
  size_t max_components;
  std::vector<Sample> found;  // one per component, nearest first

  // Farther samples of component `of` (-1: of any) cannot improve `found`.
  double Bound(int32_t of) const {
    if (of >= 0) {
      for (const Sample& sample : found) {
        if (sample.label == of) return sample.squared_distance;
      }
    }
    return found.size() < max_components ? max_squared_distance
                                         : found.back().squared_distance;
  }

  void Offer(const Sample& sample) {
    if (sample.squared_distance > max_squared_distance) return;
    auto same = std::find_if(
        found.begin(), found.end(),
        [&](const Sample& other) { return other.label == sample.label; });
    if (same != found.end()) {
      if (!Nearer(sample, *same)) return;
      found.erase(same);
    } else if (found.size() == max_components) {
      if (!Nearer(sample, found.back())) return;
      found.pop_back();
    }
    found.insert(std::upper_bound(found.begin(), found.end(), sample, Nearer),
                 sample);
  }
};

ComponentTree::ComponentTree(const VertexMatrix& positions,
                             std::span<const int32_t> labels)
    : positions_(positions) {
  order_.resize(static_cast<size_t>(positions.rows()));
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) Build(0, static_cast<int32_t>(order_.size()));
  Relabel(labels);
}

int32_t ComponentTree::Build(int32_t begin, int32_t end) {
  const auto index = static_cast<int32_t>(nodes_.size());
  Node node{positions_.row(order_[static_cast<size_t>(begin)]).transpose(),
            positions_.row(order_[static_cast<size_t>(begin)]).transpose(),
            begin,
            end,
            -1,
            -1,
            -1};
  const auto first = order_.begin() + begin;
  const auto last = order_.begin() + end;
  for (auto it = first; it != last; ++it) {
    const Eigen::Vector3d p = positions_.row(*it).transpose();
    node.low = node.low.cwiseMin(p);
    node.high = node.high.cwiseMax(p);
  }
  nodes_.push_back(node);
  if (end - begin > kComponentsPerLeaf) {
    Eigen::Index axis = 0;
    (node.high - node.low).maxCoeff(&axis);
    const int32_t middle = begin + (end - begin) / 2;
    std::nth_element(first, order_.begin() + middle, last,
                     [&](int32_t a, int32_t b) {
                       const double xa = positions_(a, axis);
                       const double xb = positions_(b, axis);
                       return xa != xb ? xa < xb : a < b;
                     });
    const int32_t left = Build(begin, middle);
    const int32_t right = Build(middle, end);
    nodes_[static_cast<size_t>(index)].left = left;
    nodes_[static_cast<size_t>(index)].right = right;
  }
  return index;
}

void ComponentTree::Relabel(std::span<const int32_t> labels) {
  labels_.assign(labels.begin(), labels.end());
  const int32_t* label_of = labels_.data();
  for (size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.left < 0) {
      const int32_t first = label_of[order_[static_cast<size_t>(node.begin)]];
      const bool uniform =
          std::all_of(order_.begin() + node.begin, order_.begin() + node.end,
                      [&](int32_t v) { return label_of[v] == first; });
      node.label = uniform ? first : -1;
    } else {
      const int32_t left = nodes_[static_cast<size_t>(node.left)].label;
      const int32_t right = nodes_[static_cast<size_t>(node.right)].label;
      node.label = left == right ? left : -1;
    }
  }
}

void ComponentTree::VisitLeaf(const Node& node, Query& query) const {
  for (int32_t i = node.begin; i < node.end; ++i) {
    const int32_t v = order_[static_cast<size_t>(i)];
    const int32_t label = labels_[static_cast<size_t>(v)];
    if (label == query.label) continue;
    const double squared =
        (positions_.row(v).transpose() - query.position).squaredNorm();
    query.Offer({squared, v, label});
  }
}

void ComponentTree::Visit(int32_t index, Query& query) const {
  const Node& node = nodes_[static_cast<size_t>(index)];
  if (node.label == query.label) return;
  const Eigen::Vector3d gap = (node.low - query.position)
                                  .cwiseMax(query.position - node.high)
                                  .cwiseMax(0.0);
  if (gap.squaredNorm() > query.Bound(node.label)) return;
  if (node.left < 0) {
    VisitLeaf(node, query);
    return;
  }
  const auto squared_gap = [&](int32_t child) {
    const Node& c = nodes_[static_cast<size_t>(child)];
    return (c.low - query.position)
        .cwiseMax(query.position - c.high)
        .cwiseMax(0.0)
        .squaredNorm();
  };
  const bool left_first = squared_gap(node.left) <= squared_gap(node.right);
  Visit(left_first ? node.left : node.right, query);
  Visit(left_first ? node.right : node.left, query);
}

std::vector<ComponentTree::Sample> ComponentTree::FindForeign(
    int32_t vertex, double max_squared_distance, int max_components) const {
  Query query{positions_.row(vertex).transpose(),
              labels_[static_cast<size_t>(vertex)],
              max_squared_distance,
              static_cast<size_t>(max_components),
              {}};
  Visit(0, query);
  return std::move(query.found);
}

}  // namespace argmesh
