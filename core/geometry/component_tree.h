// A k-d tree over samples of several components that answers: which samples of
// other components are near this one?
//
// Subtrees of the asking component are skipped whole, so a query costs
// O(log n) in practice even when its own component is large and the others are
// far away; an ordinary nearest-neighbour search would visit every sample of
// the own component first.
//
// Repeats  ties by sample index. One tree belongs to one thread while it is
//          relabelled; FindForeign is safe from many.
// Cost     O(n log n) to build, O(n) to relabel.
#ifndef ARGMESH_CORE_GEOMETRY_COMPONENT_TREE_H_
#define ARGMESH_CORE_GEOMETRY_COMPONENT_TREE_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

class ComponentTree {
 public:
  struct Sample {
    double squared_distance;
    int32_t vertex;
    int32_t label;
  };

  // `labels` has one component per row of `positions`.
  ComponentTree(const VertexMatrix& positions, std::span<const int32_t> labels);

  // After components were merged: the new component of every sample.
  void Relabel(std::span<const int32_t> labels);

  // The nearest sample of each other component within `max_squared_distance`
  // (inclusive) of `vertex`, for the `max_components` >= 1 nearest components;
  // nearest first.
  std::vector<Sample> FindForeign(int32_t vertex, double max_squared_distance,
                                  int max_components) const;

 private:
  struct Node {
    Eigen::Vector3d low, high;
    int32_t begin, end;   // samples in order_
    int32_t left, right;  // -1 for a leaf
    int32_t label;        // of all samples below, -1 when they differ
  };
  struct Query;

  int32_t Build(int32_t begin, int32_t end);
  void Visit(int32_t node, Query& query) const;
  void VisitLeaf(const Node& node, Query& query) const;

  VertexMatrix positions_;
  std::vector<int32_t> labels_;
  std::vector<int32_t> order_;
  std::vector<Node> nodes_;  // a child stands behind its parent
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_COMPONENT_TREE_H_
