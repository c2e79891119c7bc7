#include "core/geometry/spectrum.h"

#include <Spectra/SymEigsShiftSolver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <numeric>
#include <optional>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/random.h"

namespace argmesh {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

// Areas are kept above this share of the surface: M must be invertible.
constexpr double kMinAreaShare = 1e-8;
// In units of 1/area, just below the spectrum: L itself is singular.
constexpr double kShift = -0.05;
constexpr double kTolerance = 1e-6;
constexpr int kMaxRestarts = 200;
// Up to this size all pairs cost less than setting up the iteration.
constexpr int kSmallSize = 100;
constexpr uint64_t kStartSeed = 0x5eed;

// (S - shift)^-1 as Spectra wants it.
class ShiftInverse {
 public:
  using Scalar = double;

  explicit ShiftInverse(const SparseMatrix& symmetric)
      : symmetric_(symmetric) {}

  Eigen::Index rows() const { return symmetric_.rows(); }
  Eigen::Index cols() const { return symmetric_.cols(); }

  // NOLINTNEXTLINE(readability-identifier-naming): called by Spectra.
  void set_shift(const double& shift) {
    factors_.setShift(-shift);
    factors_.compute(symmetric_);
  }

  // NOLINTNEXTLINE(readability-identifier-naming): called by Spectra.
  void perform_op(const double* in, double* out) const {
    Eigen::Map<const Eigen::VectorXd> x(in, rows());
    Eigen::Map<Eigen::VectorXd> y(out, rows());
    y = factors_.solve(x);
  }

  bool factorized() const { return factors_.info() == Eigen::Success; }

 private:
  const SparseMatrix& symmetric_;
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
};

// Pairs of the symmetric matrix S = M^-1/2 L M^-1/2, ascending.
Spectrum SolveDense(const SparseMatrix& symmetric, int count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      Eigen::MatrixXd{symmetric});
  return {solver.eigenvalues().head(count),
          solver.eigenvectors().leftCols(count)};
}

Spectrum SortAscending(const Eigen::VectorXd& values,
                       const Eigen::MatrixXd& vectors) {
  std::vector<Eigen::Index> order(static_cast<size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
      order.begin(), order.end(),
      [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  Spectrum sorted{Eigen::VectorXd(values.size()),
                  Eigen::MatrixXd(vectors.rows(), vectors.cols())};
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    sorted.values[k] = values[order[static_cast<size_t>(k)]];
    sorted.vectors.col(k) = vectors.col(order[static_cast<size_t>(k)]);
  }
  return sorted;
}

std::optional<Spectrum> SolveLanczos(const SparseMatrix& symmetric, int count,
                                     int basis_size, double shift) {
  const Eigen::Index n = symmetric.rows();
  ShiftInverse op(symmetric);
  Spectra::SymEigsShiftSolver<ShiftInverse> solver(op, count, basis_size,
                                                   shift);
  if (!op.factorized()) return std::nullopt;
  Random random(kStartSeed);
  Eigen::VectorXd start(n);
  for (Eigen::Index i = 0; i < n; ++i) start[i] = random.Uniform(-1, 1);
  solver.init(start.data());
  solver.compute(Spectra::SortRule::LargestMagn, kMaxRestarts, kTolerance);
  if (solver.info() != Spectra::CompInfo::Successful) return std::nullopt;
  return SortAscending(solver.eigenvalues(), solver.eigenvectors());
}

absl::StatusOr<Spectrum> SolveSymmetric(const SparseMatrix& symmetric,
                                        int count, double shift) {
  const auto n = static_cast<int>(symmetric.rows());
  if (n <= kSmallSize || n < 3 * count) return SolveDense(symmetric, count);
  try {
    for (const int basis_size : {2 * count + 10, 4 * count + 20}) {
      auto pairs =
          SolveLanczos(symmetric, count, std::min(n, basis_size), shift);
      if (pairs) return *std::move(pairs);
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return absl::InternalError(
        absl::StrFormat("spectrum: eigenvalue solver: %s", error.what()));
  }
  return absl::InternalError(absl::StrFormat(
      "spectrum: %d eigenpairs of %d vertices did not converge", count, n));
}

// row[target]: index of the link v -> target, an edge of the mesh.
int32_t FindLink(const SurfaceGraph& graph, int32_t v, int32_t target) {
  const auto first = graph.targets.begin() + graph.offsets.data()[v];
  const auto last = graph.targets.begin() + graph.offsets.data()[v + 1];
  return static_cast<int32_t>(std::lower_bound(first, last, target) -
                              graph.targets.begin());
}

}  // namespace

std::vector<double> ComputeCotangentWeights(const TriangleMesh& mesh,
                                            const SurfaceGraph& graph,
                                            const CotangentOptions& options) {
  std::vector<double> weights(graph.targets.size(), 0);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int32_t a = mesh.F(f, (k + 1) % 3);
      const int32_t b = mesh.F(f, (k + 2) % 3);
      if (a == b) continue;
      const Eigen::Vector3d u = mesh.vertex(a) - mesh.vertex(mesh.F(f, k));
      const Eigen::Vector3d w = mesh.vertex(b) - mesh.vertex(mesh.F(f, k));
      const double twice_area = u.cross(w).norm();
      if (!(twice_area > 0)) continue;
      const double half =
          std::clamp(u.dot(w) / twice_area, -options.max_cotangent,
                     options.max_cotangent) /
          2;
      weights.data()[FindLink(graph, a, b)] += half;
      weights.data()[FindLink(graph, b, a)] += half;
    }
  }
  for (size_t e = 0; e < weights.size(); ++e) {
    switch (graph.kinds[e]) {
      case LinkKind::kEdge:
        weights[e] =
            std::clamp(weights[e], options.min_weight, options.max_weight);
        break;
      case LinkKind::kDiagonal:
        weights[e] = 0;
        break;
      case LinkKind::kBridge:
        weights[e] = options.bridge_weight;
        break;
    }
  }
  return weights;
}

Eigen::SparseMatrix<double> BuildLaplacian(const SurfaceGraph& graph,
                                           const std::vector<double>& weights) {
  const int n = graph.num_vertices();
  SparseMatrix laplacian(n, n);
  laplacian.reserve(static_cast<Eigen::Index>(weights.size()) + n);
  for (int32_t v = 0; v < n; ++v) {
    const int32_t begin = graph.offsets.data()[v];
    const int32_t end = graph.offsets.data()[v + 1];
    const double degree =
        std::accumulate(weights.begin() + begin, weights.begin() + end, 0.0);
    laplacian.startVec(v);
    int32_t e = begin;
    const auto insert_until = [&](int32_t limit) {
      for (; e < end && graph.targets.data()[e] < limit; ++e) {
        const double weight = weights.data()[e];
        if (weight != 0) {
          laplacian.insertBack(graph.targets.data()[e], v) = -weight;
        }
      }
    };
    insert_until(v);
    laplacian.insertBack(v, v) = degree;
    insert_until(n);
  }
  laplacian.finalize();
  return laplacian;
}

absl::StatusOr<Spectrum> ComputeSpectrum(const SparseMatrix& laplacian,
                                         const Eigen::VectorXd& areas,
                                         int count) {
  const Eigen::Index n = laplacian.rows();
  if (laplacian.cols() != n || areas.size() != n) {
    return absl::InvalidArgumentError(
        absl::StrFormat("spectrum: %d areas for a Laplacian of %d x %d",
                        areas.size(), n, laplacian.cols()));
  }
  if (count < 1 || count > n - 2) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "spectrum: %d eigenpairs asked, must be 1 .. %d", count, n - 2));
  }
  const double total = areas.sum();
  if (!(total > 0)) {
    return absl::InvalidArgumentError("spectrum: the areas sum to 0");
  }
  const Eigen::VectorXd scale =
      areas.cwiseMax(kMinAreaShare * total).cwiseSqrt().cwiseInverse();
  const SparseMatrix symmetric =
      scale.asDiagonal() * laplacian * scale.asDiagonal();
  auto pairs = SolveSymmetric(symmetric, count, kShift / total);
  if (!pairs.ok()) return pairs.status();
  pairs->vectors = scale.asDiagonal() * pairs->vectors;
  return pairs;
}

}  // namespace argmesh
