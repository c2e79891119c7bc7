#include "core/evaluation/class_matrix.h"

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"

namespace argmesh {
namespace {

void FindMargins(ClassMatrix& matrix) {
  const Eigen::Index k = matrix.mean.rows();
  for (Eigen::Index i = 0; i < k; ++i) {
    Eigen::Index rival = -1;
    for (Eigen::Index j = 0; j < k; ++j) {
      if (j == i) continue;
      if (rival < 0 || matrix.mean(i, j) > matrix.mean(i, rival)) rival = j;
    }
    matrix.rivals.push_back(static_cast<int>(rival));
    matrix.margins.push_back(rival < 0
                                 ? std::numeric_limits<double>::quiet_NaN()
                                 : matrix.mean(i, i) - matrix.mean(i, rival));
  }
}

}  // namespace

absl::StatusOr<ClassMatrix> ComputeClassMatrix(
    const Eigen::MatrixXd& scores, std::span<const std::string> classes) {
  const auto n = static_cast<Eigen::Index>(classes.size());
  if (scores.rows() != n || scores.cols() != n) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%d x %d scores of %d items", scores.rows(), scores.cols(), n));
  }
  ClassMatrix matrix;
  matrix.names.assign(classes.begin(), classes.end());
  std::sort(matrix.names.begin(), matrix.names.end());
  matrix.names.erase(std::unique(matrix.names.begin(), matrix.names.end()),
                     matrix.names.end());
  std::vector<Eigen::Index> class_of_item;
  for (const std::string& name : classes) {
    class_of_item.push_back(
        std::lower_bound(matrix.names.begin(), matrix.names.end(), name) -
        matrix.names.begin());
  }
  const auto k = static_cast<Eigen::Index>(matrix.names.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(k, k);
  Eigen::MatrixXd count = Eigen::MatrixXd::Zero(k, k);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (i == j) continue;
      const Eigen::Index a = class_of_item[static_cast<size_t>(i)];
      const Eigen::Index b = class_of_item[static_cast<size_t>(j)];
      sum(a, b) += scores(i, j);
      count(a, b) += 1;
    }
  }
  matrix.mean = sum.cwiseQuotient(count);
  FindMargins(matrix);
  return matrix;
}

}  // namespace argmesh
