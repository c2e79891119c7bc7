// The paper's section 3 as one call: from any triangle mesh to its modes and
// nested levels of feature enriched components (FECs).
//
// Source   "Hierarchical Surface Abstraction Using Adaptive Mean Shift",
//          section 3, read as docs/algorithm.md says.
// Input    any triangle mesh with a face of positive area.
// Ignores  translation, rotation, uniform scale, tessellation.
// Repeats  equal mesh and options give bit-equal output.
// Fails    kInvalidArgument     an option outside its range
//          kFailedPrecondition  no face of positive area
//          kResourceExhausted   more samples than the budget allows remain
//          kCancelled, kDeadlineExceeded
// Cost     about 0.25 s and 30 MB beyond the mesh. Thread-safe.
#ifndef ARGMESH_CORE_ABSTRACTION_SURFACE_ABSTRACTION_H_
#define ARGMESH_CORE_ABSTRACTION_SURFACE_ABSTRACTION_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/abstraction/decomposition.h"
#include "core/abstraction/surface_features.h"
#include "core/base/stop_token.h"
#include "core/geometry/surface_graph.h"
#include "core/mesh/mesh_repair.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/mesh_resample.h"
#include "core/mesh/mesh_smooth.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct AbstractionOptions {
  RepairOptions repair;
  ResampleOptions resample;
  TaubinOptions smooth;
  // A surface is smoothed when its boundary edges are at most this share of
  // all edges: smoothing a surface full of holes destroys it. 0 .. 1
  double max_boundary_share_smoothed = 0.02;
  FeatureOptions features;
  DecompositionOptions decomposition;
  // Farthest-point cells beside the components: patches of equal size that
  // carry the detail few components cannot. 0 .. 1000; 0 for none.
  int uniform_cells = 32;
  // Labels for DecompositionKind::kGiven: one per face of the input mesh.
  std::span<const int32_t> given_labels;
};

// How long each stage took, wall clock.
struct AbstractionTimes {
  absl::Duration repair, resample, features, decomposition;
};

struct SurfaceAbstraction {
  TriangleMesh repaired;  // the input after repair, in its own units
  // The samples: area 1, centred, x_unit = (x - centroid) * scale.
  TriangleMesh samples;
  UnitAreaTransform transform;
  SurfaceGraph edge_graph;      // edges and bridges
  SurfaceGraph geodesic_graph;  // with diagonals
  SurfaceFeatures features;

  Decomposition decomposition;
  std::vector<int32_t> uniform_cell_of_sample;  // empty when not asked for
  int num_uniform_cells = 0;

  // For each face of the input mesh the sample nearest to it; -1 for faces
  // dropped in repair.
  std::vector<int32_t> sample_of_face;
  MeshReport report;
  AbstractionTimes times;
};

absl::StatusOr<SurfaceAbstraction> AbstractSurface(
    const TriangleMesh& mesh, const AbstractionOptions& options = {},
    const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_ABSTRACTION_SURFACE_ABSTRACTION_H_
