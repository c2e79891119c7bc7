// Recursive two-way normalized cut of a weighted graph: the whole binary tree
// with the value of every cut, and nested levels cut through it.
//
// The cost of splitting S into A and B is
//   cut(A, B) * (mass(A)^-p + mass(B)^-p).
// With p = 1 and mass = degree it is Shi and Malik's. With the weight a border
// length, the mass an area and p = 1/2 it has no dimension: a part keeps its
// cut values when the shape is scaled or cut elsewhere.
//
// Source   Shi, Malik, "Normalized Cuts and Image Segmentation", PAMI 22(8),
//          2000.
// Repeats  equal input gives bit-equal output; ties by index.
// Cost     O(k^3) a split, O(k^4) at worst for k nodes; k <= 1000.
//          Thread-safe.
#ifndef ARGMESH_CORE_ABSTRACTION_NORMALIZED_CUT_H_
#define ARGMESH_CORE_ABSTRACTION_NORMALIZED_CUT_H_

#include <Eigen/Core>
#include <vector>

#include "core/abstraction/decomposition.h"

namespace argmesh {

struct CutProblem {
  Eigen::MatrixXd weights;  // k x k, symmetric, >= 0; the diagonal is ignored
  Eigen::VectorXd masses;   // k, > 0
  double mass_exponent = 0.5;  // p, 0 .. 1
};

// The tree down to single nodes; node 0 is the whole set.
std::vector<CutNode> BuildCutTree(const CutProblem& problem);

// Levels: one per threshold (ascending), then one per count (ascending), each
// continuing the one before, so that they nest. A level never has fewer
// components than the level before it.
std::vector<DecompositionLevel> CutLevels(const std::vector<CutNode>& tree,
                                          const std::vector<double>& thresholds,
                                          const std::vector<int>& counts);

}  // namespace argmesh

#endif  // ARGMESH_CORE_ABSTRACTION_NORMALIZED_CUT_H_
