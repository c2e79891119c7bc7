// A mixture of Gaussians with diagonal covariances, and the Fisher vector of a
// set of points against it.
#ifndef ARGMESH_CORE_SIGNATURE_DIAGONAL_MIXTURE_H_
#define ARGMESH_CORE_SIGNATURE_DIAGONAL_MIXTURE_H_

#include <Eigen/Core>

namespace argmesh {

// One point a row.
using PointRows =
    Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct DiagonalMixture {
  Eigen::VectorXf weights;  // K, positive, of sum 1
  PointRows means;          // K x D
  PointRows variances;      // K x D, positive

  Eigen::Index size() const { return weights.size(); }
  Eigen::Index dims() const { return means.cols(); }
};

// The probability that row i of `points` (N x D) comes from component k, N x K.
// Cost O(N K D).
PointRows ComputePosteriors(const DiagonalMixture& mixture,
                            const PointRows& points);

// K (1 + 2 D) numbers: by how much the points would change the weights, then
// the means, then the variances of the mixture. Square roots with sign, then
// unit length; zero for no points.
//
// Source   Perronnin, Sanchez, Mensink, ECCV 2010.
// Cost     O(N K D). Thread-safe.
Eigen::VectorXf EncodeFisherVector(const DiagonalMixture& mixture,
                                   const PointRows& points);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_DIAGONAL_MIXTURE_H_
