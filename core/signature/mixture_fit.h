// Fitting what a codebook consists of to points: principal axes and mixtures.
#ifndef ARGMESH_CORE_SIGNATURE_MIXTURE_FIT_H_
#define ARGMESH_CORE_SIGNATURE_MIXTURE_FIT_H_

#include <Eigen/Core>
#include <cstdint>

#include "absl/status/statusor.h"
#include "core/signature/diagonal_mixture.h"

namespace argmesh {

struct PrincipalAxes {
  Eigen::RowVectorXf mean;    // D
  PointRows axes;             // D x count, orthonormal columns, largest first
  Eigen::VectorXf variances;  // count
};

// Of N >= 2 points. The largest entry of each axis is positive.
//
// Fails    kInvalidArgument  fewer than 2 points, or count outside 1 .. D
// Cost     O(N D^2 + D^3).
absl::StatusOr<PrincipalAxes> FitPrincipalAxes(const PointRows& points,
                                               int count);

struct MixtureFitOptions {
  int components = 16;      // >= 1
  int cluster_rounds = 20;  // of k-means, from which the fit starts
  int rounds = 40;          // of expectation maximisation
  float min_variance = 1e-4F;
  uint64_t seed = 1;
};

// Seeds as k-means++ (Arthur, Vassilvitskii 2007).
//
// Repeats  equal points and options give bit-equal output.
// Fails    kInvalidArgument  fewer points than components
// Cost     O(rounds N K D).
absl::StatusOr<DiagonalMixture> FitDiagonalMixture(
    const PointRows& points, const MixtureFitOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_MIXTURE_FIT_H_
