#include "core/signature/shape_signature.h"

#include <Eigen/Core>
#include <cmath>
#include <string_view>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/base/stopwatch.h"
#include "core/signature/chirality.h"
#include "core/signature/codebook.h"
#include "core/signature/diagonal_mixture.h"
#include "core/signature/point_fields.h"
#include "core/signature/signature_surface.h"
#include "core/signature/view_patches.h"

namespace argmesh {
namespace {

constexpr float kLengthSlack = 0.01F;  // rounding to half precision

std::vector<float> RoundToHalf(const Eigen::VectorXf& values) {
  const Eigen::VectorXf rounded = values.cast<Eigen::half>().cast<float>();
  return {rounded.begin(), rounded.end()};
}

absl::Status CheckPart(std::string_view name, const std::vector<float>& part,
                       int dims) {
  if (part.size() != static_cast<size_t>(dims)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("signature: %s has %d numbers, not %d",
                        std::string(name), part.size(), dims));
  }
  float squared = 0;
  for (const float value : part) squared += value * value;
  if (squared != 0 && !(std::abs(squared - 1) <= kLengthSlack)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("signature: %s has squared length %g, not 0 or 1",
                        std::string(name), squared));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<ShapeSignature> ComputeShapeSignature(
    const TriangleMesh& repaired, const SignatureOptions& options,
    const StopToken& stop, SignatureTimes* times) {
  if (!(options.max_boundary_share >= 0 && options.max_boundary_share <= 1)) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "max_boundary_share %g is not in 0 .. 1", options.max_boundary_share));
  }
  ARGMESH_ASSIGN_OR_RETURN(const Codebook* codebook, DefaultCodebook());
  Stopwatch stopwatch;
  SignatureTimes taken;
  ARGMESH_ASSIGN_OR_RETURN(const SignatureSurface surface,
                           PrepareSurface(repaired, options, stop));
  ShapeSignature signature;
  signature.smoothed = surface.smoothed;
  signature.chirality = MeasureChirality(surface.mesh);
  taken.surface = stopwatch.Lap();
  ARGMESH_ASSIGN_OR_RETURN(const PointRows fields,
                           MeasurePointFields(surface, stop));
  signature.point = RoundToHalf(EncodeFields(*codebook, fields));
  taken.points = stopwatch.Lap();
  ARGMESH_ASSIGN_OR_RETURN(const PointRows patches,
                           DescribeViews(surface, stop));
  signature.view = RoundToHalf(EncodePatches(*codebook, patches));
  taken.views = stopwatch.Lap();
  if (times != nullptr) *times = taken;
  return signature;
}

absl::Status CheckShapeSignature(const ShapeSignature& signature) {
  ARGMESH_RETURN_IF_ERROR(CheckPart("point", signature.point, kPointDims));
  ARGMESH_RETURN_IF_ERROR(CheckPart("view", signature.view, kViewDims));
  for (const float value : signature.chirality) {
    if (!(std::abs(value) <= 1)) {
      return absl::InvalidArgumentError(
          absl::StrFormat("signature: chirality %g is not in -1 .. 1", value));
    }
  }
  return absl::OkStatus();
}

}  // namespace argmesh
