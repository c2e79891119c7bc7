// The windows of a surface before they are projected to the codebook.
//
// Fails    kFailedPrecondition  no face of positive area
//          kCancelled, kDeadlineExceeded
// Repeats  equal input gives bit-equal output. Thread-safe.
#ifndef ARGMESH_CORE_CONTAINMENT_WINDOW_EXTRACTION_H_
#define ARGMESH_CORE_CONTAINMENT_WINDOW_EXTRACTION_H_

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/containment/surface_samples.h"
#include "core/containment/window_descriptor.h"
#include "core/containment/window_set.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct ExtractionPlan {
  int num_samples = 32768;
  double first_radius = kFirstTargetRadius;
  int num_levels = kNumTargetLevels;
  int accept_cap = 800;          // centres a level
  int describe_cap = 800;        // of them described; the first
  double boundary_margin = 0.8;  // in radii
  bool orient_open = true;       // turn open pieces outwards
  uint64_t seed = 1;
};

// What ExtractTargetWindows does with these options.
ExtractionPlan TargetPlan(int level_cap, uint64_t seed);

struct RawLevel {
  std::vector<DescribedWindow> windows;
  int32_t accepted = 0;
};

struct RawWindowSet {
  WindowFrame frame;
  SurfaceSamples samples;
  std::vector<RawLevel> levels;
};

absl::StatusOr<RawWindowSet> ExtractRawWindows(const TriangleMesh& repaired,
                                               const ExtractionPlan& plan,
                                               const StopToken& stop = {});

// The radius of a level, in units of sqrt(area).
float LevelRadius(double first_radius, int level);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_WINDOW_EXTRACTION_H_
