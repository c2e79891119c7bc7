// The discrete Laplacian of a sampled surface and its spectrum.
#ifndef ARGMESH_CORE_GEOMETRY_SPECTRUM_H_
#define ARGMESH_CORE_GEOMETRY_SPECTRUM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/geometry/surface_graph.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct CotangentOptions {
  double max_cotangent = 5;    // each cotangent is clamped to +- this, > 0
  double min_weight = 0.01;    // of a link after summing, >= 0
  double max_weight = 1e30;    // of a link after summing
  double bridge_weight = 0.1;  // of a bridge link, >= 0
};

// (cot a + cot b) / 2 for every link of `graph`, aligned with graph.targets;
// 0 for diagonals. Cost O(m log k).
std::vector<double> ComputeCotangentWeights(
    const TriangleMesh& mesh, const SurfaceGraph& graph,
    const CotangentOptions& options = {});

// L = D - W: symmetric, positive semi-definite for weights >= 0, rows sum to
// 0. `weights` is aligned with graph.targets and symmetric.
Eigen::SparseMatrix<double> BuildLaplacian(const SurfaceGraph& graph,
                                           const std::vector<double>& weights);

// The smallest eigenpairs of L u = lambda M u, M = diag(areas).
struct Spectrum {
  Eigen::VectorXd values;   // k, ascending, the first about 0
  Eigen::MatrixXd vectors;  // n x k, u_i^T M u_j = delta_ij; signs are free
};

// `count` smallest pairs, 1 .. n-2, by shift-invert Lanczos.
//
// Fails    kInvalidArgument  count out of range
//          kInternal         not converged
//          kCancelled, kDeadlineExceeded  within one factorisation
// Cost     one sparse factorisation and O(count^2 n).
absl::StatusOr<Spectrum> ComputeSpectrum(
    const Eigen::SparseMatrix<double>& laplacian, const Eigen::VectorXd& areas,
    int count, const StopToken& stop = {});

struct WaveKernelOptions {
  int num_energies = 16;     // >= 2
  double min_energy = 3;     // eigenvalue units of the area-1 surface, > 0
  double max_energy = 600;   // > min_energy
  double sigma_steps = 1.5;  // width in steps of the log-energy grid, > 0
};

// Wave kernel signature, n x num_energies, about 1 on average at area 1.
// Source: Aubry, Schlickewei, Cremers, "The Wave Kernel Signature", ICCVW 2011.
Eigen::MatrixXd ComputeWaveKernelSignature(
    const Spectrum& spectrum, const WaveKernelOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_SPECTRUM_H_
