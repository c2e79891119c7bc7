#include "core/geometry/surface_bridges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/geometry/component_tree.h"

namespace argmesh {
namespace {

constexpr int kMaxBridgesPerSample = 4;
constexpr int32_t kNone = std::numeric_limits<int32_t>::max();

// Disjoint sets; the root of a set is its smallest member.
class ComponentSets {
 public:
  explicit ComponentSets(int count) : parent_(static_cast<size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int32_t Root(int32_t i) {
    int32_t* parent = parent_.data();
    while (parent[i] != i) {
      parent[i] = parent[parent[i]];
      i = parent[i];
    }
    return i;
  }

  // False when they are one set already.
  bool Join(int32_t a, int32_t b) {
    a = Root(a);
    b = Root(b);
    if (a == b) return false;
    parent_[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
    return true;
  }

 private:
  std::vector<int32_t> parent_;
};

struct Candidate {
  double squared_length = std::numeric_limits<double>::infinity();
  int32_t from = kNone;
  int32_t to = kNone;

  // One order over all pairs of samples, the same from both ends, so that the
  // choices of a round never close a cycle.
  bool operator<(const Candidate& other) const {
    return std::tie(squared_length, from, to) <
           std::tie(other.squared_length, other.from, other.to);
  }
};

Candidate MakeCandidate(int32_t v, const ComponentTree::Sample& sample) {
  return {sample.squared_distance, std::min(v, sample.vertex),
          std::max(v, sample.vertex)};
}

class BridgeBuilder {
 public:
  BridgeBuilder(const VertexMatrix& positions,
                std::span<const int32_t> component_of_vertex,
                int num_components)
      : component_(component_of_vertex),
        sets_(num_components),
        num_sets_(num_components),
        tree_(positions, component_of_vertex) {}

  void JoinWithin(double radius) {
    for (int32_t v = 0; v < num_vertices(); ++v) {
      for (const auto& sample :
           tree_.FindForeign(v, radius * radius, kMaxBridgesPerSample)) {
        Add(MakeCandidate(v, sample));
      }
    }
  }

  void JoinRest() {
    while (num_sets_ > 1) {
      const std::vector<Candidate> nearest = FindNearestOfEachSet();
      for (const Candidate& candidate : nearest) {
        if (candidate.from != kNone &&
            component(candidate.from) != component(candidate.to)) {
          Add(candidate);
        }
      }
    }
  }

  std::vector<Bridge> Take() {
    std::sort(bridges_.begin(), bridges_.end(),
              [](const Bridge& a, const Bridge& b) {
                return std::tie(a.from, a.to) < std::tie(b.from, b.to);
              });
    const auto last = std::unique(bridges_.begin(), bridges_.end(),
                                  [](const Bridge& a, const Bridge& b) {
                                    return a.from == b.from && a.to == b.to;
                                  });
    bridges_.erase(last, bridges_.end());
    return std::move(bridges_);
  }

 private:
  int32_t num_vertices() const {
    return static_cast<int32_t>(component_.size());
  }
  int32_t component(int32_t v) {
    return sets_.Root(component_[static_cast<size_t>(v)]);
  }

  void Add(const Candidate& c) {
    if (sets_.Join(component_[static_cast<size_t>(c.from)],
                   component_[static_cast<size_t>(c.to)])) {
      --num_sets_;
    }
    bridges_.push_back({c.from, c.to, std::sqrt(c.squared_length)});
  }

  std::vector<Candidate> FindNearestOfEachSet() {
    std::vector<int32_t> labels(component_.size());
    for (int32_t v = 0; v < num_vertices(); ++v) {
      labels[static_cast<size_t>(v)] = component(v);
    }
    tree_.Relabel(labels);
    std::vector<Candidate> nearest(labels.size());
    for (int32_t v = 0; v < num_vertices(); ++v) {
      Candidate& best =
          nearest[static_cast<size_t>(labels[static_cast<size_t>(v)])];
      for (const auto& sample : tree_.FindForeign(v, best.squared_length, 1)) {
        best = std::min(best, MakeCandidate(v, sample));
      }
    }
    return nearest;
  }

  std::span<const int32_t> component_;
  ComponentSets sets_;
  int num_sets_;
  ComponentTree tree_;
  std::vector<Bridge> bridges_;
};

}  // namespace

std::vector<Bridge> ComputeBridges(const VertexMatrix& positions,
                                   std::span<const int32_t> component_of_vertex,
                                   int num_components, double radius) {
  if (num_components < 2) return {};
  BridgeBuilder builder(positions, component_of_vertex, num_components);
  builder.JoinWithin(radius);
  builder.JoinRest();
  return builder.Take();
}

}  // namespace argmesh
