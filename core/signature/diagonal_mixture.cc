#include "core/signature/diagonal_mixture.h"

#include <cmath>

namespace argmesh {

PointRows ComputePosteriors(const DiagonalMixture& mixture,
                            const PointRows& points) {
  const PointRows precision = mixture.variances.cwiseInverse();
  const PointRows scaled_means = mixture.means.cwiseProduct(precision);
  const Eigen::RowVectorXf constant =
      (mixture.weights.array().log() -
       0.5F * (mixture.means.cwiseProduct(scaled_means).rowwise().sum() +
               mixture.variances.array().log().matrix().rowwise().sum())
                  .array())
          .matrix()
          .transpose();
  PointRows posteriors = points * scaled_means.transpose();
  posteriors.noalias() -=
      0.5F * (points.cwiseAbs2() * precision.transpose()).eval();
  posteriors.rowwise() += constant;
  for (Eigen::Index i = 0; i < posteriors.rows(); ++i) {
    auto row = posteriors.row(i).array();
    row = (row - row.maxCoeff()).exp();
    row /= row.sum();
  }
  return posteriors;
}

Eigen::VectorXf EncodeFisherVector(const DiagonalMixture& mixture,
                                   const PointRows& points) {
  const Eigen::Index k = mixture.size();
  const Eigen::Index d = mixture.dims();
  Eigen::VectorXf vector = Eigen::VectorXf::Zero(k * (1 + 2 * d));
  if (points.rows() == 0) return vector;
  const PointRows posteriors = ComputePosteriors(mixture, points);
  const auto count = static_cast<float>(points.rows());
  const Eigen::VectorXf mass = posteriors.colwise().sum().transpose();
  const PointRows first = posteriors.transpose() * points;
  const PointRows second = posteriors.transpose() * points.cwiseAbs2();
  for (Eigen::Index c = 0; c < k; ++c) {
    const auto mean = mixture.means.row(c).array();
    const auto variance = mixture.variances.row(c).array();
    const float root = std::sqrt(mixture.weights[c]);
    vector[c] = (mass[c] / count - mixture.weights[c]) / root;
    vector.segment(k + c * d, d) = ((first.row(c).array() - mass[c] * mean) /
                                    variance.sqrt() / (count * root))
                                       .matrix()
                                       .transpose();
    vector.segment(k + (k + c) * d, d) =
        (((second.row(c).array() - 2 * mean * first.row(c).array() +
           mass[c] * mean.square()) /
              variance -
          mass[c]) /
         (count * root * std::sqrt(2.0F)))
            .matrix()
            .transpose();
  }
  vector = vector.array().sign() * vector.array().abs().sqrt();
  const float length = vector.norm();
  if (length > 0) vector /= length;
  return vector;
}

}  // namespace argmesh
