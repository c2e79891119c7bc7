#include "core/signature/mixture_fit.h"

#include <Eigen/Eigenvalues>
#include <cstddef>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/random.h"

namespace argmesh {
namespace {

constexpr float kMinWeight = 1e-4F;

PointRows SeedCenters(const PointRows& points, int count, Random& random) {
  PointRows centers(count, points.cols());
  centers.row(0) = points.row(static_cast<Eigen::Index>(
      random.Below(static_cast<uint64_t>(points.rows()))));
  Eigen::VectorXf nearest =
      (points.rowwise() - centers.row(0)).rowwise().squaredNorm();
  for (int c = 1; c < count; ++c) {
    double left = random.Uniform() * nearest.cast<double>().sum();
    Eigen::Index chosen = 0;
    while (chosen + 1 < points.rows() && left >= nearest[chosen]) {
      left -= static_cast<double>(nearest[chosen++]);
    }
    centers.row(c) = points.row(chosen);
    nearest = nearest.cwiseMin(
        (points.rowwise() - centers.row(c)).rowwise().squaredNorm());
  }
  return centers;
}

// The nearest center of each point.
std::vector<Eigen::Index> AssignPoints(const PointRows& points,
                                       const PointRows& centers) {
  PointRows closeness = points * centers.transpose();
  closeness.rowwise() -= 0.5F * centers.rowwise().squaredNorm().transpose();
  std::vector<Eigen::Index> nearest(static_cast<size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    closeness.row(i).maxCoeff(&nearest[static_cast<size_t>(i)]);
  }
  return nearest;
}

// Means, variances and weights of the points that `shares` (N x K) gives to
// each component; a component without points stays as it is.
void UpdateMixture(const PointRows& points, const PointRows& shares,
                   float min_variance, DiagonalMixture& mixture) {
  const Eigen::VectorXf mass = shares.colwise().sum().transpose();
  const PointRows first = shares.transpose() * points;
  const PointRows second = shares.transpose() * points.cwiseAbs2();
  for (Eigen::Index c = 0; c < mixture.size(); ++c) {
    mixture.weights[c] = mass[c] / static_cast<float>(points.rows());
    if (mixture.weights[c] < kMinWeight) {
      mixture.weights[c] = kMinWeight;
      continue;
    }
    mixture.means.row(c) = first.row(c) / mass[c];
    mixture.variances.row(c) =
        (second.row(c) / mass[c] - mixture.means.row(c).cwiseAbs2())
            .cwiseMax(min_variance);
  }
  mixture.weights /= mixture.weights.sum();
}

DiagonalMixture ClusterPoints(const PointRows& points,
                              const MixtureFitOptions& options) {
  Random random(options.seed);
  DiagonalMixture mixture;
  mixture.means = SeedCenters(points, options.components, random);
  mixture.weights = Eigen::VectorXf::Constant(
      options.components, 1.0F / static_cast<float>(options.components));
  mixture.variances = PointRows::Ones(options.components, points.cols());
  for (int round = 0; round < options.cluster_rounds; ++round) {
    const std::vector<Eigen::Index> nearest =
        AssignPoints(points, mixture.means);
    PointRows shares = PointRows::Zero(points.rows(), options.components);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      shares(i, nearest[static_cast<size_t>(i)]) = 1;
    }
    UpdateMixture(points, shares, options.min_variance, mixture);
  }
  return mixture;
}

}  // namespace

absl::StatusOr<PrincipalAxes> FitPrincipalAxes(const PointRows& points,
                                               int count) {
  if (points.rows() < 2 || count < 1 || count > points.cols()) {
    return absl::InvalidArgumentError(
        absl::StrFormat("%d axes of %d points in %d dimensions", count,
                        points.rows(), points.cols()));
  }
  PrincipalAxes fitted;
  fitted.mean = points.cast<double>().colwise().mean().cast<float>();
  const Eigen::MatrixXd centered =
      (points.rowwise() - fitted.mean).cast<double>();
  const Eigen::MatrixXd covariance =
      centered.transpose() * centered / static_cast<double>(points.rows() - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  fitted.axes.resize(points.cols(), count);
  fitted.variances.resize(count);
  for (int k = 0; k < count; ++k) {
    const Eigen::Index from = points.cols() - 1 - k;
    Eigen::VectorXd axis = solver.eigenvectors().col(from);
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    if (axis[largest] < 0) axis = -axis;
    fitted.axes.col(k) = axis.cast<float>();
    fitted.variances[k] =
        static_cast<float>(std::max(0.0, solver.eigenvalues()[from]));
  }
  return fitted;
}

absl::StatusOr<DiagonalMixture> FitDiagonalMixture(
    const PointRows& points, const MixtureFitOptions& options) {
  if (options.components < 1 || points.rows() < options.components) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%d components for %d points", options.components, points.rows()));
  }
  DiagonalMixture mixture = ClusterPoints(points, options);
  for (int round = 0; round < options.rounds; ++round) {
    UpdateMixture(points, ComputePosteriors(mixture, points),
                  options.min_variance, mixture);
  }
  return mixture;
}

}  // namespace argmesh
