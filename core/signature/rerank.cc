#include "core/signature/rerank.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"

namespace argmesh {
namespace {

using List = std::vector<Eigen::Index>;

absl::Status CheckInput(const Eigen::MatrixXd& similarity,
                        const RerankOptions& options) {
  if (similarity.rows() != similarity.cols() || similarity.rows() < 1) {
    return absl::InvalidArgumentError(
        absl::StrFormat("similarities of %d x %d shapes", similarity.rows(),
                        similarity.cols()));
  }
  for (Eigen::Index i = 0; i < similarity.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double value = similarity(i, j);
      if (!(value >= 0 && value <= 1) || value != similarity(j, i)) {
        return absl::InvalidArgumentError(absl::StrFormat(
            "similarity %g of shapes %d and %d, and %g of %d and %d: not one "
            "number in 0 .. 1",
            value, i, j, similarity(j, i), j, i));
      }
    }
  }
  if (options.neighbors < 1 || options.expansion < 1) {
    return absl::InvalidArgumentError(
        absl::StrFormat("neighbors %d and expansion %d must be at least 1",
                        options.neighbors, options.expansion));
  }
  if (!(options.original_share >= 0 && options.original_share <= 1)) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "original_share %g is not in 0 .. 1", options.original_share));
  }
  return absl::OkStatus();
}

// Of every shape all shapes, nearest first, itself in front.
std::vector<List> RankAll(const Eigen::MatrixXd& distance) {
  std::vector<List> ranks;
  for (Eigen::Index i = 0; i < distance.rows(); ++i) {
    List order(static_cast<size_t>(distance.rows()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      if ((a == i) != (b == i)) return a == i;
      return distance(i, a) != distance(i, b) ? distance(i, a) < distance(i, b)
                                              : a < b;
    });
    ranks.push_back(std::move(order));
  }
  return ranks;
}

bool Contains(const List& list, size_t head, Eigen::Index item) {
  const auto end =
      list.begin() + static_cast<std::ptrdiff_t>(std::min(head, list.size()));
  return std::find(list.begin(), end, item) != end;
}

// Those of the k nearest shapes of i that have i among their own k nearest,
// ascending.
List ReciprocalNeighbors(const std::vector<List>& ranks, Eigen::Index i,
                         size_t k) {
  const List& own = ranks[static_cast<size_t>(i)];
  List found;
  for (size_t r = 0; r < std::min(k + 1, own.size()); ++r) {
    if (Contains(ranks[static_cast<size_t>(own[r])], k + 1, i)) {
      found.push_back(own[r]);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

// The reciprocal neighbours and those of theirs that are mostly the same.
List ExpandedNeighbors(const std::vector<List>& ranks, Eigen::Index i,
                       size_t k) {
  const List own = ReciprocalNeighbors(ranks, i, k);
  List all = own;
  for (const Eigen::Index candidate : own) {
    const List theirs = ReciprocalNeighbors(ranks, candidate, (k + 1) / 2);
    List common;
    std::set_intersection(own.begin(), own.end(), theirs.begin(), theirs.end(),
                          std::back_inserter(common));
    if (3 * common.size() > 2 * theirs.size()) {
      all.insert(all.end(), theirs.begin(), theirs.end());
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Row i: how much of a neighbour every shape is to i; of sum 1.
Eigen::MatrixXd EncodeNeighborhoods(const Eigen::MatrixXd& distance,
                                    const std::vector<List>& ranks, size_t k) {
  const Eigen::Index n = distance.rows();
  Eigen::MatrixXd encoded = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double widest = std::max(distance.row(i).maxCoeff(), 1e-12);
    for (const Eigen::Index j : ExpandedNeighbors(ranks, i, k)) {
      encoded(i, j) = std::exp(-distance(i, j) / widest);
    }
    encoded.row(i) /= encoded.row(i).sum();
  }
  return encoded;
}

Eigen::MatrixXd AverageOverNearest(const Eigen::MatrixXd& encoded,
                                   const std::vector<List>& ranks,
                                   size_t count) {
  Eigen::MatrixXd averaged =
      Eigen::MatrixXd::Zero(encoded.rows(), encoded.cols());
  for (Eigen::Index i = 0; i < encoded.rows(); ++i) {
    const List& nearest = ranks[static_cast<size_t>(i)];
    const size_t used = std::min(count, nearest.size());
    for (size_t r = 0; r < used; ++r) {
      averaged.row(i) += encoded.row(nearest[r]) / static_cast<double>(used);
    }
  }
  return averaged;
}

}  // namespace

absl::StatusOr<Eigen::VectorXd> RerankShortList(
    const Eigen::MatrixXd& similarity, const RerankOptions& options) {
  if (const absl::Status status = CheckInput(similarity, options);
      !status.ok()) {
    return status;
  }
  const Eigen::MatrixXd distance = 1 - similarity.array();
  const std::vector<List> ranks = RankAll(distance);
  const Eigen::MatrixXd encoded = AverageOverNearest(
      EncodeNeighborhoods(distance, ranks,
                          static_cast<size_t>(options.neighbors)),
      ranks, static_cast<size_t>(options.expansion));
  const double widest = std::max(distance.row(0).maxCoeff(), 1e-12);
  Eigen::VectorXd scores(similarity.rows() - 1);
  for (Eigen::Index i = 1; i < similarity.rows(); ++i) {
    const double common = encoded.row(0).cwiseMin(encoded.row(i)).sum();
    const double jaccard = 1 - common / (2 - common);
    scores[i - 1] = 1 - (options.original_share * distance(0, i) / widest +
                         (1 - options.original_share) * jaccard);
  }
  return scores;
}

}  // namespace argmesh
