#include "server/engine/surface_description.h"

#include "core/base/status_macros.h"
#include "core/containment/target_windows.h"
#include "core/containment/window_codec.h"
#include "core/signature/signature_codec.h"

namespace argmesh {

absl::StatusOr<SurfaceDescription> DescribeSurface(const TriangleMesh& repaired,
                                                   const StopToken& stop) {
  SurfaceDescription surface;
  ARGMESH_ASSIGN_OR_RETURN(surface.signature,
                           ComputeShapeSignature(repaired, {}, stop));
  ARGMESH_ASSIGN_OR_RETURN(const TargetWindows windows,
                           ExtractTargetWindows(repaired, {}, stop));
  surface.words = AssignWindowWords(windows);
  surface.bytes.signature = EncodeSignature(surface.signature);
  surface.bytes.window_words = SerializeWindowWords(surface.words);
  surface.bytes.windows = SerializeTargetWindows(windows);
  return surface;
}

}  // namespace argmesh
