// The windows of a piece of surface that is looked for.
//
// 16,384 seeded samples; at each of 7 levels up to `level_cap` centres half a
// radius apart and at least 0.8 radii from the open boundary: what lies
// beyond a cut is not known.
//
// Input    a repaired mesh (core/mesh RepairMesh), own units.
// Repeats  equal input gives bit-equal output.
// Fails    kFailedPrecondition  no face of positive area
//          kInvalidArgument     an option outside its range
//          kCancelled, kDeadlineExceeded
// Cost     about 0.03 s and 4 MB. Thread-safe.
#ifndef ARGMESH_CORE_CONTAINMENT_QUERY_WINDOWS_H_
#define ARGMESH_CORE_CONTAINMENT_QUERY_WINDOWS_H_

#include <cstdint>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/containment/window_set.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct QueryWindowsOptions {
  int level_cap = 60;     // windows a level, 4 .. 200
  int num_points = 2048;  // 512 .. 16,384
  uint64_t seed = 1;
};

absl::StatusOr<QueryWindows> ExtractQueryWindows(
    const TriangleMesh& repaired, const QueryWindowsOptions& options = {},
    const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_QUERY_WINDOWS_H_
