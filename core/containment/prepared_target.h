// A target laid out for verification.
//
// Immutable once made, thread-safe. About 0.7 MB; 2 ms to make.
#ifndef ARGMESH_CORE_CONTAINMENT_PREPARED_TARGET_H_
#define ARGMESH_CORE_CONTAINMENT_PREPARED_TARGET_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/containment/descriptor_table.h"
#include "core/containment/sampled_surface.h"
#include "core/containment/window_set.h"

namespace argmesh {

struct PreparedLevel {
  DescriptorTable descriptors;
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
};

struct PreparedTarget {
  explicit PreparedTarget(const TargetWindows& windows);

  WindowFrame frame;
  std::array<PreparedLevel, kNumTargetLevels> levels;
  SampledSurface surface;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_PREPARED_TARGET_H_
