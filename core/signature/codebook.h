// What signatures are measured against: frozen, so that signatures of
// different collections can be compared.
//
// Made by tests/benchmark/make_signature_codebook; its bytes are part of the
// program (signature_codebook.bin). Another codebook needs another
// kSignatureVersion.
#ifndef ARGMESH_CORE_SIGNATURE_CODEBOOK_H_
#define ARGMESH_CORE_SIGNATURE_CODEBOOK_H_

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/signature/diagonal_mixture.h"
#include "core/signature/shape_signature.h"

namespace argmesh {

inline constexpr int kNumFields = 12;   // quantities of a point
inline constexpr int kFieldKnots = 65;  // of the scale of each quantity
inline constexpr int kPointMixtureSize = 32;
inline constexpr int kPatchDims = 128;  // gradient histogram of a patch
inline constexpr int kPlaceDims = 2;    // where a patch lies
inline constexpr int kPatchAxes = 30;   // kept of a gradient histogram
inline constexpr int kViewMixtureSize = 16;
// Knots stand for the normal scores -kMaxScore .. kMaxScore in even steps:
// the quantiles 0.002 .. 0.998.
inline constexpr float kMaxScore = 2.878F;

struct Codebook {
  // kNumFields x kFieldKnots: ascending values of each quantity.
  PointRows field_knots;
  // Scores to uncorrelated coordinates of variance 1: (x - mean) * axes.
  Eigen::RowVectorXf field_mean;  // kNumFields
  PointRows field_axes;           // kNumFields x kNumFields
  DiagonalMixture points;         // kPointMixtureSize in kNumFields

  Eigen::RowVectorXf patch_mean;  // kPatchDims
  PointRows patch_axes;           // kPatchDims x kPatchAxes
  DiagonalMixture patches;        // kViewMixtureSize in kPatchAxes + kPlaceDims

  // Means of the Fisher vectors of many shapes: what all shapes have in
  // common tells none of them apart.
  Eigen::VectorXf point_mean;  // kPointDims
  Eigen::VectorXf view_mean;   // kViewDims
};

// The normal score of a value of a quantity; ties take the middle of theirs.
float FieldScore(const Codebook& codebook, int field, float value);

// Points (N x kNumFields) in the coordinates of codebook.points.
PointRows NormalizeFields(const Codebook& codebook, const PointRows& fields);
// Patches (N x (kPatchDims + kPlaceDims)) in the coordinates of
// codebook.patches.
PointRows ProjectPatches(const Codebook& codebook, const PointRows& patches);

// The parts of a signature: Fisher vectors less their mean, of unit length.
// Zero for no rows.
Eigen::VectorXf EncodeFields(const Codebook& codebook, const PointRows& fields);
Eigen::VectorXf EncodePatches(const Codebook& codebook,
                              const PointRows& patches);

// Sealed bytes of floats, about 35 KB.
std::string EncodeCodebook(const Codebook& codebook);

// Fails    kDataLoss            damaged, or numbers no codebook can have
//          kFailedPrecondition  of another kSignatureVersion
absl::StatusOr<Codebook> DecodeCodebook(std::string_view bytes);

// The one that signatures are made with; read and checked once.
//
// Fails    kInternal  the program's copy is damaged
absl::StatusOr<const Codebook*> DefaultCodebook();

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_CODEBOOK_H_
