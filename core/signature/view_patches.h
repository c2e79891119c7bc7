// Gradient histograms all over the views of a surface: what the VIEW part of a
// signature is made of.
#ifndef ARGMESH_CORE_SIGNATURE_VIEW_PATCHES_H_
#define ARGMESH_CORE_SIGNATURE_VIEW_PATCHES_H_

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/signature/diagonal_mixture.h"
#include "core/signature/signature_surface.h"

namespace argmesh {

// Up to 42 views x 72 patches rows of kPatchDims numbers of unit length, then
// the patch's distance from the middle of the image (0 .. 1.42) and its depth
// (0 .. 1); patches of three sizes around pixels of the shape. No rows for a
// surface too thin to be seen.
//
// Repeats  equal input gives bit-equal output.
// Fails    kCancelled, kDeadlineExceeded
// Cost     about 60 ms. Thread-safe.
absl::StatusOr<PointRows> DescribeViews(const SignatureSurface& surface,
                                        const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_VIEW_PATCHES_H_
