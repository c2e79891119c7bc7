// Re-ranking of a short list by neighbourhood: shapes whose nearest shapes are
// the query's nearest shapes too come first.
//
// What it finds depends on the other shapes in the list, so its scores are an
// order and mean nothing by themselves; it is an option beside the plain
// ranking, not a part of it.
//
// Source   Zhong, Zheng, Cao, Li, "Re-ranking Person Re-identification with
//          k-reciprocal Encoding", CVPR 2017.
#ifndef ARGMESH_CORE_SIGNATURE_RERANK_H_
#define ARGMESH_CORE_SIGNATURE_RERANK_H_

#include <Eigen/Core>

#include "absl/status/statusor.h"

namespace argmesh {

struct RerankOptions {
  // About as many as a shape has mates; k1 and k2 of the paper.
  int neighbors = 10;           // whose reciprocity is asked, >= 1
  int expansion = 3;            // whose encodings are averaged, >= 1
  double original_share = 0.3;  // of the plain distance in the result, 0 .. 1
};

// `similarity` is n x n, symmetric, in 0 .. 1; row 0 is the query and the
// others the short list. Returns n - 1 scores in 0 .. 1 of items 1 .. n-1.
//
// Repeats  equal input gives bit-equal output; equal similarities rank by
//          index.
// Fails    kInvalidArgument  not square, not symmetric, a value or an option
//                            outside its range
// Cost     O(n^2 log n) at most, about 2 ms for n = 100. Thread-safe.
absl::StatusOr<Eigen::VectorXd> RerankShortList(
    const Eigen::MatrixXd& similarity, const RerankOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_RERANK_H_
