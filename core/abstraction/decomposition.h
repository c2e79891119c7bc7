// Decompositions of a sampled surface into nested levels of components, behind
// one interface.
//
// kBiharmonic   adaptive mean shift in biharmonic position and log shape
//               diameter, then normalized cut (the default)
// kNormalCurvature  adaptive mean shift in position, normal, mean and Gaussian
//               curvature with the paper's tests on delta(m) and f(m)
// kVoronoi      farthest-point geodesic cells: the control without mean shift
// kGiven        labels from outside, grouped by normalized cut
#ifndef ARGMESH_CORE_ABSTRACTION_DECOMPOSITION_H_
#define ARGMESH_CORE_ABSTRACTION_DECOMPOSITION_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/abstraction/surface_features.h"
#include "core/base/stop_token.h"
#include "core/geometry/surface_graph.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

enum class DecompositionKind {
  kBiharmonic,
  kNormalCurvature,
  kVoronoi,
  kGiven
};

// "biharmonic", "normal-curvature", "voronoi", "given".
std::string_view DecompositionName(DecompositionKind kind);

struct BiharmonicOptions {
  int eigenvectors = 12;          // 1 .. 100
  double thickness_weight = 0.3;  // of log2 shape diameter in the joint space
  double concavity_scale = 0.05;  // length that makes curvature dimensionless
  double concavity_floor = 0.0;   // concavity below this is no crease
  double concavity_width = 0.1;   // > 0
  double thickness_width = 0.5;   // > 0
  double min_conductance = 0.02;  // 0 .. 1, share left at the sharpest crease
  int super_samples = 600;        // 10 .. 100,000 points that shift
  double min_window = 0.03;       // w_MIN, joint-space units, > 0
  double max_window = 0.07;       // w_MAX, >= min_window
  double window_growth = 1.15;    // factor between windows, > 1
};

struct NormalCurvatureOptions {
  double min_window = 0.06;      // w_MIN, sqrt(area)
  double max_window = 0.12;      // w_MAX
  double window_step = 0.03;     // delta w
  double range_bandwidth = 0.4;  // h_r
  double min_density = 0.55;     // f(m): mass in the joint / spatial window
  double max_offset = 0.4;       // |delta(m)| in units of the windows
  double mode_distance_scale = 0.12;  // sigma of eq. 3, sqrt(area), > 0
};

struct DecompositionOptions {
  DecompositionKind kind = DecompositionKind::kBiharmonic;
  BiharmonicOptions biharmonic;
  NormalCurvatureOptions normal_curvature;
  int voronoi_cells = 64;          // 2 .. 1000, kVoronoi only
  double min_region_area = 0.003;  // smaller regions are absorbed
  int max_regions = 96;            // 1 .. 1000
  // Levels: first by Ncut threshold, ascending, then by component count.
  std::vector<double> level_thresholds = {1.6, 2.0, 2.4, 2.8};
  std::vector<int> level_counts = {16};
};

// The defaults of each kind: which levels, how small a region may be.
DecompositionOptions DecompositionOptionsFor(DecompositionKind kind);

// A statistical mode found in the first stage.
struct Mode {
  int32_t sample = 0;         // nearest sample of the surface
  float window = 0;           // w_max: the largest window it was stable under
  int32_t repeatability = 1;  // windows it was stable under
  float density = 0;          // f(m), share of the surface's mass
  float offset = 0;           // |delta(m)| over the window at w_max
  int32_t region = 0;         // finest region it stands for
};

// One cut through the tree of components.
struct DecompositionLevel {
  double threshold = 0;  // largest Ncut value cut at; 0 for a count level
  int32_t count = 0;     // asked-for components; 0 for a threshold level
  int num_components = 0;
  std::vector<int32_t> component_of_region;
  std::vector<int32_t>
      parent;  // component of the level before; -1 at the first
};

// The normalized cut that split a component in two.
struct CutNode {
  double ncut = 0;  // value of its best cut; infinite for a leaf
  int32_t children[2] = {-1, -1};
  std::vector<int32_t> regions;
};

struct Decomposition {
  std::vector<Mode> modes;
  std::vector<int32_t> region_of_sample;  // the finest components (FECs)
  int num_regions = 0;
  std::vector<CutNode> cut_tree;           // node 0 is the whole surface
  std::vector<DecompositionLevel> levels;  // coarse to fine, nested

  // Component of every sample at `level`.
  std::vector<int32_t> ComponentOfSample(int level) const;
};

// Everything a decomposition may look at; references must outlive the call.
struct DecompositionInput {
  const TriangleMesh& samples;
  const SurfaceFeatures& features;
  const SurfaceGraph& edge_graph;
  const SurfaceGraph& geodesic_graph;
  std::span<const int32_t> given_labels;  // per sample, kGiven only
};

// Fails    kInvalidArgument  an option outside its range, labels missing
//          kInternal         an eigenproblem did not converge
//          kCancelled, kDeadlineExceeded
// Cost     about 40 ms for 3,000 samples. Thread-safe.
absl::StatusOr<Decomposition> DecomposeSurface(
    const DecompositionInput& input, const DecompositionOptions& options = {},
    const StopToken& stop = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_ABSTRACTION_DECOMPOSITION_H_
