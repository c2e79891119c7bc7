// The windows of a shape in which queries are looked for.
//
// 32,768 seeded samples; at each of 9 levels centres half a radius apart, at
// most `level_cap`. Windows cut by an open boundary are left out, because a
// query never has any.
//
// Input    a repaired mesh (core/mesh RepairMesh), own units. An open piece
//          whose normals point to the inside of what it encloses is turned.
// Repeats  equal input gives bit-equal output.
// Fails    kFailedPrecondition  no face of positive area
//          kInvalidArgument     an option outside its range
//          kCancelled, kDeadlineExceeded
// Cost     about 0.08 s and 8 MB a mesh, nearly whatever its size.
//          Thread-safe.
#ifndef ARGMESH_CORE_CONTAINMENT_TARGET_WINDOWS_H_
#define ARGMESH_CORE_CONTAINMENT_TARGET_WINDOWS_H_

#include <cstdint>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/containment/window_set.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct TargetWindowsOptions {
  int level_cap = 800;    // windows a level, 10 .. 4,000
  int num_points = 8192;  // 512 .. 32,768
  uint64_t seed = 1;
};

absl::StatusOr<TargetWindows> ExtractTargetWindows(
    const TriangleMesh& repaired, const TargetWindowsOptions& options = {},
    const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_TARGET_WINDOWS_H_
