// From the bytes of a mesh to its graph, with errors a client can act on.
#ifndef ARGMESH_SERVER_ENGINE_MESH_ANALYSIS_H_
#define ARGMESH_SERVER_ENGINE_MESH_ANALYSIS_H_

#include <cstdint>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/stop_token.h"
#include "core/graph/compute_graph.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/triangle_mesh.h"
#include "server/engine/collection_record.h"
#include "server/engine/engine_options.h"
#include "server/engine/mesh_memory.h"
#include "server/engine/shape_record.h"

namespace argmesh {

struct AnalyzedMesh {
  TriangleMesh mesh;  // as it came
  ComputedGraph computed;
  MeshFormat format = MeshFormat::kUnknown;
  // Ends with options.max_compute_time too: for all else that is computed of
  // this mesh.
  StopToken within;
  MeshMemoryClaim memory;  // until all of that is done
};

class MeshAnalyzer {
 public:
  // Both must outlive it. A mesh waits up to `max_wait` for its memory.
  MeshAnalyzer(const EngineOptions& options, MeshMemory& memory,
               absl::Duration max_wait)
      : options_(options), memory_(memory), max_wait_(max_wait) {}

  // Parses, repairs, abstracts.
  //
  // Fails    MESH_MALFORMED (metadata `line` or `offset` where known),
  //          MESH_FORMAT_UNKNOWN, MESH_EMPTY, MESH_DEGENERATE,
  //          MESH_TOO_LARGE (over a limit, over options.max_compute_time or
  //          over the memory), OVERLOADED (MeshMemory)
  //          kCancelled, kDeadlineExceeded of `stop`
  // Cost     the time counts from after the parse, which itself is not stopped
  absl::StatusOr<AnalyzedMesh> Analyze(std::string_view bytes,
                                       MeshFormat format,
                                       const CollectionSettings& settings,
                                       const StopToken& stop) const;

  // From the mesh on.
  absl::StatusOr<AnalyzedMesh> AnalyzeParsed(TriangleMesh mesh,
                                             const CollectionSettings& settings,
                                             const StopToken& stop) const;

 private:
  const EngineOptions& options_;
  MeshMemory& memory_;
  const absl::Duration max_wait_;
};

// `status`, or MESH_TOO_LARGE when options.max_compute_time has ended what was
// computed, and not the caller's `stop`.
absl::Status OverComputeTime(const absl::Status& status, const StopToken& stop,
                             const EngineOptions& options);

// MESH_TOO_LARGE from the size alone.
absl::Status CheckMeshSize(int64_t bytes, const MeshLimits& limits);

GraphSummary SummarizeGraph(const ShapeGraph& graph);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_MESH_ANALYSIS_H_
