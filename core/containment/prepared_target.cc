#include "core/containment/prepared_target.h"

namespace argmesh {

PreparedTarget::PreparedTarget(const TargetWindows& windows)
    : frame(windows.frame), surface(MakeSampledSurface(windows.points)) {
  for (size_t l = 0; l < levels.size(); ++l) {
    levels[l].descriptors = DescriptorTable(windows.levels[l].descriptors);
    for (const PackedPoint& point : windows.levels[l].frames) {
      levels[l].positions.push_back(UnpackPosition(point));
      levels[l].normals.push_back(UnpackNormal(point));
    }
  }
}

}  // namespace argmesh
