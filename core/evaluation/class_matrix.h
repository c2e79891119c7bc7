// Mean scores between classes: is every class most like itself, and by how
// much? The paper's Figure 8.
//
// Input    n x n scores, larger is more alike, a class for each item.
// Output   pairs of an item with itself are left out; a class of one item has
//          no score with itself (NaN, and margin NaN).
// Fails    kInvalidArgument  sizes that do not fit
// Cost     O(n^2). Thread-safe.
#ifndef ARGMESH_CORE_EVALUATION_CLASS_MATRIX_H_
#define ARGMESH_CORE_EVALUATION_CLASS_MATRIX_H_

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace argmesh {

struct ClassMatrix {
  std::vector<std::string> names;  // sorted
  Eigen::MatrixXd mean;  // (i, j): queries of class i against items of class j
  // Of each class: its score with itself less the best with another class;
  // > 0 when the diagonal is the maximum of the row.
  std::vector<double> margins;
  std::vector<int> rivals;  // that other class; -1 when there is none
};

absl::StatusOr<ClassMatrix> ComputeClassMatrix(
    const Eigen::MatrixXd& scores, std::span<const std::string> classes);

}  // namespace argmesh

#endif  // ARGMESH_CORE_EVALUATION_CLASS_MATRIX_H_
