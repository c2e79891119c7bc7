// Twelve quantities of surface points: what the POINT part of a signature is
// made of. Nothing of them changes with position and rotation.
#ifndef ARGMESH_CORE_SIGNATURE_POINT_FIELDS_H_
#define ARGMESH_CORE_SIGNATURE_POINT_FIELDS_H_

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/signature/diagonal_mixture.h"
#include "core/signature/signature_surface.h"

namespace argmesh {

inline constexpr int kDescribedPoints = 1024;

// Columns of the result. Lengths in units of sqrt(area).
enum PointField {
  kShapeIndexNear,  // (2/pi) atan((k1 + k2) / (k1 - k2)) within 0.05
  kCurvednessNear,  // log(sqrt((k1^2 + k2^2) / 2) + 0.02), k in units of 1/0.05
  kAreaNear,        // surface within 0.05 over that of a flat disc
  kOffsetNear,      // of the mean of that surface along the normal, over 0.05
  kShapeIndexWide,  // the same within 0.10
  kCurvednessWide,
  kAreaWide,
  kOffsetWide,
  kThickness,   // shape diameter, as in core/geometry/shape_diameter.h
  kOcclusion,   // share of outward rays that meet the surface
  kCentrality,  // distance from the centroid
  kGeodesic,    // mean distance along the surface to points all over it
};

// kDescribedPoints x kNumFields.
//
// Repeats  equal input gives bit-equal output.
// Fails    kInternal  the ray tracer could not be set up
//          kCancelled, kDeadlineExceeded
// Cost     about 60 ms. Thread-safe.
absl::StatusOr<PointRows> MeasurePointFields(const SignatureSurface& surface,
                                             const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_POINT_FIELDS_H_
