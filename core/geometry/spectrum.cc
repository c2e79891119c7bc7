#include "core/geometry/spectrum.h"

#include <Spectra/SymEigsShiftSolver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <new>
#include <numeric>
#include <optional>
#include <utility>

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
// Basis vectors beyond the wanted pairs.
constexpr int kSpareVectors = 40;
// Up to this size all pairs cost less than setting up the iteration.
constexpr int kSmallSize = 100;
constexpr int kMaxPasses = 64;
constexpr uint64_t kStartSeed = 0x5eed;

// How an iteration that knows no other way out ends early.
struct Stopped : std::exception {
  explicit Stopped(absl::Status why) : status(std::move(why)) {}
  absl::Status status;
};

// (S - shift)^-1 on the complement of `locked`, as Spectra wants it.
class ShiftInverse {
 public:
  using Scalar = double;

  ShiftInverse(const SparseMatrix& symmetric, const Eigen::MatrixXd& locked,
               const StopToken& stop)
      : symmetric_(symmetric), locked_(locked), stop_(stop) {}

  Eigen::Index rows() const { return symmetric_.rows(); }
  Eigen::Index cols() const { return symmetric_.cols(); }

  // NOLINTNEXTLINE(readability-identifier-naming): called by Spectra.
  void set_shift(const double& shift) {
    factors_.setShift(-shift);
    factors_.compute(symmetric_);
  }

  // NOLINTNEXTLINE(readability-identifier-naming): called by Spectra.
  void perform_op(const double* in, double* out) const {
    if (absl::Status status = stop_.Check(); !status.ok()) {
      throw Stopped(std::move(status));
    }
    Eigen::Map<const Eigen::VectorXd> x(in, rows());
    Eigen::Map<Eigen::VectorXd> y(out, rows());
    y = factors_.solve(x);
    if (locked_.cols() > 0) y -= locked_ * (locked_.transpose() * y).eval();
  }

  bool factorized() const { return factors_.info() == Eigen::Success; }

 private:
  const SparseMatrix& symmetric_;
  const Eigen::MatrixXd& locked_;
  const StopToken& stop_;
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
};

// Pairs of the symmetric matrix S = M^-1/2 L M^-1/2, ascending.
Spectrum SolveDense(const SparseMatrix& symmetric, int count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      Eigen::MatrixXd{symmetric});
  return {solver.eigenvalues().head(count),
          solver.eigenvectors().leftCols(count)};
}

// The `count` smallest of the pairs of `a` and `b`, ascending.
Spectrum Merge(const Spectrum& a, const Spectrum& b, Eigen::Index count) {
  Eigen::VectorXd values(a.values.size() + b.values.size());
  values << a.values, b.values;
  std::vector<Eigen::Index> order(static_cast<size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
      order.begin(), order.end(),
      [&](Eigen::Index i, Eigen::Index j) { return values[i] < values[j]; });
  count = std::min(count, values.size());
  Spectrum merged{Eigen::VectorXd(count),
                  Eigen::MatrixXd(b.vectors.rows(), count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index from = order[static_cast<size_t>(k)];
    merged.values[k] = values[from];
    if (from < a.values.size()) {
      merged.vectors.col(k) = a.vectors.col(from);
    } else {
      merged.vectors.col(k) = b.vectors.col(from - a.values.size());
    }
  }
  return merged;
}

// The `count` smallest pairs orthogonal to `locked`. Each `seed` sees another
// vector of every eigenspace.
std::optional<Spectrum> SolveLanczos(const SparseMatrix& symmetric,
                                     const Eigen::MatrixXd& locked, int count,
                                     double shift, uint64_t seed,
                                     const StopToken& stop) {
  const Eigen::Index n = symmetric.rows();
  Random random(seed);
  Eigen::VectorXd start(n);
  for (Eigen::Index i = 0; i < n; ++i) start[i] = random.Uniform(-1, 1);
  if (locked.cols() > 0) start -= locked * (locked.transpose() * start).eval();
  ShiftInverse op(symmetric, locked, stop);
  for (const int spare : {kSpareVectors, kSpareVectors + 3 * count}) {
    const auto basis_size = std::min<Eigen::Index>(n, count + spare);
    Spectra::SymEigsShiftSolver<ShiftInverse> solver(op, count, basis_size,
                                                     shift);
    if (!op.factorized()) return std::nullopt;
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestMagn, kMaxRestarts, kTolerance);
    if (solver.info() != Spectra::CompInfo::Successful) continue;
    return Merge({}, {solver.eigenvalues(), solver.eigenvectors()}, count);
  }
  return std::nullopt;
}

// How many eigenvalues are below `limit`, by Sylvester's law of inertia.
std::optional<int> CountBelow(const SparseMatrix& symmetric, double limit) {
  Eigen::SimplicialLDLT<SparseMatrix> factors;
  factors.setShift(-limit);
  factors.compute(symmetric);
  if (factors.info() != Eigen::Success) return std::nullopt;
  return static_cast<int>((factors.vectorD().array() < 0).count());
}

// One Lanczos run sees one vector of each eigenspace, and the other vectors of
// a multiple eigenvalue (any symmetric shape has some) only by rounding. So
// the pairs are counted, and missing ones are looked for in the complement.
std::optional<Spectrum> SolveComplete(const SparseMatrix& symmetric, int count,
                                      double shift, const StopToken& stop) {
  uint64_t seed = kStartSeed;
  auto found =
      SolveLanczos(symmetric, Eigen::MatrixXd(), count, shift, seed, stop);
  for (int pass = 0; found && pass < kMaxPasses; ++pass) {
    // Below a cluster at the end of the list, of which some are not wanted.
    const double last = found->values[count - 1];
    const double limit = last - 1e-5 * (std::abs(last) - shift);
    const auto known =
        static_cast<int>((found->values.array() < limit).count());
    const std::optional<int> expected = CountBelow(symmetric, limit);
    if (!expected) return std::nullopt;
    if (*expected <= known) return found;
    const auto copies =
        SolveLanczos(symmetric, found->vectors,
                     std::min(*expected - known, count), shift, ++seed, stop);
    if (!copies) return std::nullopt;
    found = Merge(*found, *copies, count);
  }
  return std::nullopt;
}

absl::StatusOr<Spectrum> SolveSymmetric(const SparseMatrix& symmetric,
                                        int count, double shift,
                                        const StopToken& stop) {
  const auto n = static_cast<int>(symmetric.rows());
  if (n <= kSmallSize || n < 3 * count) return SolveDense(symmetric, count);
  try {
    auto pairs = SolveComplete(symmetric, count, shift, stop);
    if (pairs) return *std::move(pairs);
  } catch (const Stopped& stopped) {
    return stopped.status;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return absl::InternalError(
        absl::StrFormat("spectrum: eigenvalue solver: %s", error.what()));
  }
  return absl::InternalError(absl::StrFormat(
      "spectrum: %d eigenpairs of %d vertices did not converge", count, n));
}

}  // namespace

absl::StatusOr<Spectrum> ComputeSpectrum(const SparseMatrix& laplacian,
                                         const Eigen::VectorXd& areas,
                                         int count, const StopToken& stop) {
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
  auto pairs = SolveSymmetric(symmetric, count, kShift / total, stop);
  if (!pairs.ok()) return pairs.status();
  pairs->vectors = scale.asDiagonal() * pairs->vectors;
  return pairs;
}

}  // namespace argmesh
