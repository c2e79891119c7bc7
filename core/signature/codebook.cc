#include "core/signature/codebook.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/sealed_bytes.h"
#include "core/base/status_macros.h"
#include "core/signature/signature_codec.h"

// Laid down by argmesh_embed.
extern "C" {
extern const char argmesh_signature_codebook_begin[];
extern const char argmesh_signature_codebook_end[];
}

namespace argmesh {
namespace {

constexpr std::string_view kCodebookMagic = "ARGC";
constexpr std::string_view kCodebookName = "signature codebook";
// Places vary about as much as the widest axis of the histograms.
const Eigen::Array<float, 1, kPlaceDims> kPlaceMiddle(0.4F, 0.65F);
const Eigen::Array<float, 1, kPlaceDims> kPlaceScale(0.5F, 1.0F);

template <typename Matrix>
void WriteMatrix(const Matrix& matrix, ByteWriter& writer) {
  writer.WriteF32Array(std::span<const float>(
      matrix.data(), static_cast<size_t>(matrix.size())));
}

template <typename Matrix>
absl::Status ReadMatrix(Eigen::Index rows, Eigen::Index cols,
                        ByteReader& reader, Matrix& matrix) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::vector<float> values,
      reader.ReadF32Array(static_cast<size_t>(rows * cols)));
  matrix.resize(rows, cols);
  std::copy(values.begin(), values.end(), matrix.data());
  return matrix.allFinite()
             ? absl::OkStatus()
             : absl::DataLossError("signature codebook: not finite");
}

void WriteMixture(const DiagonalMixture& mixture, ByteWriter& writer) {
  WriteMatrix(mixture.weights, writer);
  WriteMatrix(mixture.means, writer);
  WriteMatrix(mixture.variances, writer);
}

absl::Status ReadMixture(Eigen::Index size, Eigen::Index dims,
                         ByteReader& reader, DiagonalMixture& mixture) {
  ARGMESH_RETURN_IF_ERROR(ReadMatrix(size, 1, reader, mixture.weights));
  ARGMESH_RETURN_IF_ERROR(ReadMatrix(size, dims, reader, mixture.means));
  ARGMESH_RETURN_IF_ERROR(ReadMatrix(size, dims, reader, mixture.variances));
  if (mixture.weights.minCoeff() <= 0 || mixture.variances.minCoeff() <= 0) {
    return absl::DataLossError(
        "signature codebook: a weight or variance is not positive");
  }
  return absl::OkStatus();
}

absl::Status CheckKnots(const PointRows& knots) {
  for (Eigen::Index f = 0; f < knots.rows(); ++f) {
    for (Eigen::Index k = 1; k < knots.cols(); ++k) {
      if (knots(f, k) < knots(f, k - 1)) {
        return absl::DataLossError(absl::StrFormat(
            "signature codebook: knots of quantity %d descend at %d", f, k));
      }
    }
  }
  return absl::OkStatus();
}

Eigen::VectorXf Centered(const Eigen::VectorXf& fisher_vector,
                         const Eigen::VectorXf& mean) {
  if (fisher_vector.isZero(0)) return fisher_vector;
  return (fisher_vector - mean).normalized();
}

}  // namespace

float FieldScore(const Codebook& codebook, int field, float value) {
  const float* const first = codebook.field_knots.row(field).data();
  const float* const last = first + kFieldKnots;
  const float* const low = std::lower_bound(first, last, value);
  const float* const high = std::upper_bound(low, last, value);
  constexpr float kStep = 2 * kMaxScore / (kFieldKnots - 1);
  const auto place = static_cast<float>(low - first);
  if (low == last) return kMaxScore;
  if (high != low) {
    return kStep * (place + static_cast<float>(high - low - 1) / 2) - kMaxScore;
  }
  if (low == first) return -kMaxScore;
  const float share = (value - low[-1]) / (low[0] - low[-1]);
  return kStep * (place - 1 + share) - kMaxScore;
}

PointRows NormalizeFields(const Codebook& codebook, const PointRows& fields) {
  PointRows scores(fields.rows(), kNumFields);
  for (Eigen::Index i = 0; i < fields.rows(); ++i) {
    for (int f = 0; f < kNumFields; ++f) {
      scores(i, f) = FieldScore(codebook, f, fields(i, f));
    }
  }
  return (scores.rowwise() - codebook.field_mean) * codebook.field_axes;
}

PointRows ProjectPatches(const Codebook& codebook, const PointRows& patches) {
  PointRows projected(patches.rows(), kPatchAxes + kPlaceDims);
  projected.leftCols(kPatchAxes) =
      (patches.leftCols(kPatchDims).rowwise() - codebook.patch_mean) *
      codebook.patch_axes;
  const auto place = patches.rightCols(kPlaceDims).array();
  projected.rightCols(kPlaceDims) =
      ((place.rowwise() - kPlaceMiddle).rowwise() * kPlaceScale).matrix();
  return projected;
}

Eigen::VectorXf EncodeFields(const Codebook& codebook,
                             const PointRows& fields) {
  return Centered(
      EncodeFisherVector(codebook.points, NormalizeFields(codebook, fields)),
      codebook.point_mean);
}

Eigen::VectorXf EncodePatches(const Codebook& codebook,
                              const PointRows& patches) {
  return Centered(
      EncodeFisherVector(codebook.patches, ProjectPatches(codebook, patches)),
      codebook.view_mean);
}

std::string EncodeCodebook(const Codebook& codebook) {
  ByteWriter writer;
  WriteMatrix(codebook.field_knots, writer);
  WriteMatrix(codebook.field_mean, writer);
  WriteMatrix(codebook.field_axes, writer);
  WriteMixture(codebook.points, writer);
  WriteMatrix(codebook.patch_mean, writer);
  WriteMatrix(codebook.patch_axes, writer);
  WriteMixture(codebook.patches, writer);
  WriteMatrix(codebook.point_mean, writer);
  WriteMatrix(codebook.view_mean, writer);
  return SealBytes(kCodebookMagic, kSignatureVersion, writer.bytes());
}

absl::StatusOr<Codebook> DecodeCodebook(std::string_view bytes) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::string_view payload,
      OpenSealedBytes(kCodebookName, kCodebookMagic, kSignatureVersion, bytes));
  ByteReader reader(payload, kCodebookName);
  Codebook codebook;
  ARGMESH_RETURN_IF_ERROR(
      ReadMatrix(kNumFields, kFieldKnots, reader, codebook.field_knots));
  ARGMESH_RETURN_IF_ERROR(CheckKnots(codebook.field_knots));
  ARGMESH_RETURN_IF_ERROR(
      ReadMatrix(1, kNumFields, reader, codebook.field_mean));
  ARGMESH_RETURN_IF_ERROR(
      ReadMatrix(kNumFields, kNumFields, reader, codebook.field_axes));
  ARGMESH_RETURN_IF_ERROR(
      ReadMixture(kPointMixtureSize, kNumFields, reader, codebook.points));
  ARGMESH_RETURN_IF_ERROR(
      ReadMatrix(1, kPatchDims, reader, codebook.patch_mean));
  ARGMESH_RETURN_IF_ERROR(
      ReadMatrix(kPatchDims, kPatchAxes, reader, codebook.patch_axes));
  ARGMESH_RETURN_IF_ERROR(ReadMixture(kViewMixtureSize, kPatchAxes + kPlaceDims,
                                      reader, codebook.patches));
  ARGMESH_RETURN_IF_ERROR(
      ReadMatrix(kPointDims, 1, reader, codebook.point_mean));
  ARGMESH_RETURN_IF_ERROR(ReadMatrix(kViewDims, 1, reader, codebook.view_mean));
  ARGMESH_RETURN_IF_ERROR(reader.ExpectEnd());
  return codebook;
}

absl::StatusOr<const Codebook*> DefaultCodebook() {
  static const absl::StatusOr<Codebook> codebook =
      DecodeCodebook({argmesh_signature_codebook_begin,
                      static_cast<size_t>(argmesh_signature_codebook_end -
                                          argmesh_signature_codebook_begin)});
  if (!codebook.ok()) {
    return absl::InternalError(absl::StrFormat(
        "the program's copy: %s", std::string(codebook.status().message())));
  }
  return &*codebook;
}

}  // namespace argmesh
