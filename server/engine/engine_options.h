// Limits and sizes of an engine.
#ifndef ARGMESH_SERVER_ENGINE_ENGINE_OPTIONS_H_
#define ARGMESH_SERVER_ENGINE_ENGINE_OPTIONS_H_

#include <cstdint>

#include "absl/time/time.h"
#include "core/mesh/mesh_format.h"
#include "server/engine/compute_pool.h"

namespace argmesh {

struct EngineOptions {
  ComputePoolOptions pool;
  // Of one mesh, in an ingest or as a query.
  MeshLimits mesh_limits;
  // Longest computation of one mesh: its graph and what describes its surface,
  // from after its parse, which is not stopped; > 0.
  absl::Duration max_compute_time = absl::Seconds(120);
  // What all meshes under computation may take together, bytes, > 0
  // (MeshMemory).
  int64_t mesh_memory = 2LL << 30;
  // How long a request_id is remembered; > 0.
  absl::Duration request_memory = absl::Hours(24);
  // Meshes that no row names are swept at the start when older; >= 0.
  absl::Duration sweep_age = absl::Hours(1);
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_ENGINE_OPTIONS_H_
