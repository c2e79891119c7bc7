#include <algorithm>
#include <cmath>

#include "core/geometry/spectrum.h"

namespace argmesh {
namespace {

// Eigenvalues near 0 (surfaces in nearly separate parts) count as this.
constexpr double kMinEigenvalue = 1e-3;

}  // namespace

Eigen::MatrixXd ComputeWaveKernelSignature(const Spectrum& spectrum,
                                           const WaveKernelOptions& options) {
  const Eigen::Index k = spectrum.values.size();
  const Eigen::Index n = spectrum.vectors.rows();
  if (k < 2) return Eigen::MatrixXd::Ones(n, options.num_energies);
  // Without the constant function, which says nothing.
  const Eigen::ArrayXd log_values =
      spectrum.values.tail(k - 1).array().max(kMinEigenvalue).log();
  const double low = std::log(options.min_energy);
  const double step =
      (std::log(options.max_energy) - low) / (options.num_energies - 1);
  const double sigma = options.sigma_steps * step;
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(k - 1, options.num_energies);
  for (int j = 0; j < options.num_energies; ++j) {
    const Eigen::ArrayXd distance = (log_values - (low + j * step)) / sigma;
    const Eigen::ArrayXd gaussian = (-0.5 * distance.square()).exp();
    if (gaussian.sum() > 1e-9) {
      weights.col(j) = (gaussian / gaussian.sum()).matrix();
    }
  }
  Eigen::MatrixXd signature =
      spectrum.vectors.rightCols(k - 1).cwiseAbs2() * weights;
  // No eigenvalue near this energy was computed: the average value.
  for (int j = 0; j < options.num_energies; ++j) {
    if (weights.col(j).isZero(0)) signature.col(j).setOnes();
  }
  return signature;
}

}  // namespace argmesh
