#include "core/signature/compact_basis.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/random.h"
#include "core/base/sealed_bytes.h"
#include "core/base/status_macros.h"
#include "core/signature/signature_codec.h"
#include "core/signature/similarity_scale.h"

namespace argmesh {
namespace {

constexpr std::string_view kBasisMagic = "ARGB";
constexpr std::string_view kBasisName = "compact basis";
constexpr size_t kMaxFitted = 4096;
// Directions searched beside those kept, and rounds of the search.
constexpr int kSpare = 16;
constexpr int kRounds = 4;
constexpr uint64_t kSeed = 1;
// Axes along which the signatures differ by less, of the widest, are noise.
constexpr double kSmallestVariance = 1e-10;
constexpr float kLargestCode = 127;

// Parts count as they do in similarity.
Eigen::VectorXf Flatten(const ShapeSignature& signature) {
  Eigen::VectorXf flat(kSignatureDims);
  const auto part = [](const std::vector<float>& values, double share) {
    return static_cast<float>(std::sqrt(share)) *
           Eigen::Map<const Eigen::VectorXf>(
               values.data(), static_cast<Eigen::Index>(values.size()));
  };
  flat.head(kPointDims) = part(signature.point, kPointScale.weight);
  flat.tail(kViewDims) = part(signature.view, kViewScale.weight);
  return flat;
}

// One signature a row, centred.
Eigen::MatrixXf CenteredRows(std::span<const ShapeSignature* const> signatures,
                             Eigen::VectorXf& mean) {
  const size_t count = std::min(signatures.size(), kMaxFitted);
  Eigen::MatrixXf rows(static_cast<Eigen::Index>(count), kSignatureDims);
  for (size_t i = 0; i < count; ++i) {
    rows.row(static_cast<Eigen::Index>(i)) =
        Flatten(*signatures[i * signatures.size() / count]).transpose();
  }
  mean = rows.cast<double>().colwise().mean().cast<float>().transpose();
  rows.rowwise() -= mean.transpose();
  return rows;
}

// An orthonormal basis of the columns' span, as many columns.
Eigen::MatrixXf Orthonormalize(const Eigen::MatrixXf& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> qr(columns);
  return qr.householderQ() *
         Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

// Principal axes of the rows by subspace iteration from a seeded start
// (Halko, Martinsson, Tropp, SIAM Review 2011).
absl::StatusOr<Eigen::MatrixXf> FindAxes(const Eigen::MatrixXf& rows,
                                         const StopToken& stop) {
  const Eigen::Index searched =
      std::min<Eigen::Index>(rows.rows(), kCompactDims + kSpare);
  Random random(kSeed);
  Eigen::MatrixXf basis(rows.cols(), searched);
  for (float& value : basis.reshaped()) {
    value = static_cast<float>(random.Normal());
  }
  for (int round = 0; round < kRounds; ++round) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    const Eigen::MatrixXf seen = rows * basis;
    basis = Orthonormalize(rows.transpose() * seen);
  }
  const Eigen::MatrixXd seen = (rows * basis).cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(seen.transpose() *
                                                              seen);
  const Eigen::VectorXd& variances = solver.eigenvalues();
  Eigen::Index kept = 0;
  while (kept < std::min<Eigen::Index>(searched, kCompactDims) &&
         variances[searched - 1 - kept] >
             kSmallestVariance * variances[searched - 1]) {
    ++kept;
  }
  Eigen::MatrixXf axes =
      basis *
      solver.eigenvectors().rowwise().reverse().leftCols(kept).cast<float>();
  for (auto axis : axes.colwise()) {
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    if (axis[largest] < 0) axis *= -1;
  }
  return axes;
}

}  // namespace

absl::StatusOr<CompactBasis> FitCompactBasis(
    std::span<const ShapeSignature* const> signatures, const StopToken& stop) {
  CompactBasis basis;
  if (signatures.size() < 2) {
    return absl::FailedPreconditionError(
        absl::StrFormat("a compact basis of %d signatures", signatures.size()));
  }
  const Eigen::MatrixXf rows = CenteredRows(signatures, basis.mean);
  if (!(rows.cwiseAbs().maxCoeff() > 1e-6F)) {
    return absl::FailedPreconditionError(absl::StrFormat(
        "a compact basis of %d equal signatures", signatures.size()));
  }
  ARGMESH_ASSIGN_OR_RETURN(basis.axes, FindAxes(rows, stop));
  return basis;
}

CompactVector ProjectSignature(const CompactBasis& basis,
                               const ShapeSignature& signature) {
  const Eigen::VectorXf projected =
      basis.axes.transpose() * (Flatten(signature) - basis.mean);
  CompactVector vector{};
  const float length = projected.norm();
  if (!(length > 0)) return vector;
  for (Eigen::Index k = 0; k < projected.size(); ++k) {
    vector[static_cast<size_t>(k)] =
        static_cast<int8_t>(std::lround(projected[k] / length * kLargestCode));
  }
  return vector;
}

double CompactSimilarity(const CompactVector& a, const CompactVector& b) {
  int32_t product = 0;
  int32_t squared_a = 0;
  int32_t squared_b = 0;
  for (size_t k = 0; k < a.size(); ++k) {
    product += int32_t{a[k]} * int32_t{b[k]};
    squared_a += int32_t{a[k]} * int32_t{a[k]};
    squared_b += int32_t{b[k]} * int32_t{b[k]};
  }
  if (squared_a == 0 || squared_b == 0) return 0;
  return product / std::sqrt(static_cast<double>(squared_a) *
                             static_cast<double>(squared_b));
}

std::string EncodeCompactBasis(const CompactBasis& basis) {
  ByteWriter writer;
  writer.WriteF32Array({basis.mean.data(), kSignatureDims});
  writer.WriteU32(static_cast<uint32_t>(basis.axes.cols()));
  writer.WriteF32Array(
      {basis.axes.data(), static_cast<size_t>(basis.axes.size())});
  return SealBytes(kBasisMagic, kSignatureVersion, writer.bytes());
}

absl::StatusOr<CompactBasis> DecodeCompactBasis(std::string_view bytes) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::string_view payload,
      OpenSealedBytes(kBasisName, kBasisMagic, kSignatureVersion, bytes));
  ByteReader reader(payload, kBasisName);
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<float> mean,
                           reader.ReadF32Array(kSignatureDims));
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t count,
                           reader.ReadCount(kSignatureDims * sizeof(float)));
  if (count < 1 || count > kCompactDims) {
    return absl::DataLossError(absl::StrFormat(
        "compact basis: %d axes, not 1 .. %d", count, kCompactDims));
  }
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<float> axes,
                           reader.ReadF32Array(size_t{count} * kSignatureDims));
  ARGMESH_RETURN_IF_ERROR(reader.ExpectEnd());
  CompactBasis basis;
  basis.mean = Eigen::Map<const Eigen::VectorXf>(mean.data(), kSignatureDims);
  basis.axes =
      Eigen::Map<const Eigen::MatrixXf>(axes.data(), kSignatureDims, count);
  if (!basis.mean.allFinite() || !basis.axes.allFinite()) {
    return absl::DataLossError("compact basis: not finite");
  }
  return basis;
}

}  // namespace argmesh
