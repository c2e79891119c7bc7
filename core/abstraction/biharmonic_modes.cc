#include <algorithm>
#include <cmath>

#include "core/abstraction/conductance.h"
#include "core/abstraction/first_stage.h"
#include "core/abstraction/mean_shift.h"
#include "core/abstraction/voronoi_regions.h"
#include "core/base/status_macros.h"
#include "core/geometry/geodesic.h"
#include "core/geometry/spectrum.h"

namespace argmesh {
namespace {

constexpr double kMinEigenvalue = 1e-3;

// The joint space, dim x samples: eigenvectors over their eigenvalues, whose
// distances are Lipman, Rustamov, Funkhouser's biharmonic distance ("Biharmonic
// Distance", ACM TOG 29(3), 2010), and log shape diameter.
absl::StatusOr<Eigen::MatrixXd> EmbedSamples(
    const DecompositionInput& input, const std::vector<double>& conductances,
    const BiharmonicOptions& options, const StopToken& stop) {
  const int n = input.samples.num_vertices();
  const int count = std::min(options.eigenvectors, n - 3);
  if (count < 1) return Eigen::MatrixXd::Zero(1, n);
  ARGMESH_ASSIGN_OR_RETURN(
      const Spectrum spectrum,
      ComputeSpectrum(BuildLaplacian(input.edge_graph, conductances),
                      input.features.areas, count + 1, stop));
  Eigen::MatrixXd joint(count + 1, n);
  for (int k = 0; k < count; ++k) {
    joint.row(k) = spectrum.vectors.col(k + 1).transpose() /
                   std::max(spectrum.values[k + 1], kMinEigenvalue);
  }
  joint.row(count) =
      (options.thickness_weight / std::log(2.0)) *
      input.features.shape_diameter.array().max(kMinDiameter).log().transpose();
  return joint;
}

struct SuperSamples {
  FarthestPointCells cells;
  Eigen::MatrixXf points;  // dim x cells, area means in the joint space
  Eigen::VectorXf masses;  // area of each cell
};

SuperSamples MakeSuperSamples(const DecompositionInput& input,
                              const Eigen::MatrixXd& joint, int count) {
  SuperSamples super;
  super.cells = ComputeFarthestPointCells(input.geodesic_graph, count,
                                          FarthestFromOrigin(input.samples));
  const auto num_cells = static_cast<Eigen::Index>(super.cells.seeds.size());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(joint.rows(), num_cells);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(num_cells);
  for (int v = 0; v < input.samples.num_vertices(); ++v) {
    const int cell = super.cells.cell_of_vertex[static_cast<size_t>(v)];
    sums.col(cell) += input.features.areas[v] * joint.col(v);
    masses[cell] += input.features.areas[v];
  }
  for (Eigen::Index cell = 0; cell < num_cells; ++cell) {
    sums.col(cell) /= masses[cell];
  }
  super.points = sums.cast<float>();
  super.masses = masses.cast<float>();
  return super;
}

}  // namespace

absl::StatusOr<FirstStage> FindBiharmonicModes(const DecompositionInput& input,
                                               const BiharmonicOptions& options,
                                               const StopToken& stop) {
  FirstStage stage;
  stage.link_weights = ComputeConductances(input.samples, input.features,
                                           input.edge_graph, options);
  ARGMESH_ASSIGN_OR_RETURN(
      const Eigen::MatrixXd joint,
      EmbedSamples(input, stage.link_weights, options, stop));
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  const SuperSamples super =
      MakeSuperSamples(input, joint, options.super_samples);
  MeanShiftOptions shift;
  shift.min_window = options.min_window;
  shift.max_window = options.max_window;
  shift.window_growth = options.window_growth;
  ARGMESH_ASSIGN_OR_RETURN(
      const MeanShiftResult shifted,
      RunMeanShift(super.points, super.masses, shift, stop));

  stage.label_of_sample.reserve(super.cells.cell_of_vertex.size());
  for (const int32_t cell : super.cells.cell_of_vertex) {
    const int32_t mode = shifted.mode_of_point[static_cast<size_t>(cell)];
    stage.label_of_sample.push_back(
        shifted.survivor_of_mode[static_cast<size_t>(mode)]);
  }
  for (const ShiftedMode& found : shifted.modes) {
    Mode mode;
    mode.sample = super.cells.seeds[static_cast<size_t>(found.nearest_point)];
    mode.window = found.window;
    mode.repeatability = found.repeatability;
    mode.density = found.density;
    mode.offset = found.offset;
    stage.modes.push_back(mode);
  }
  return stage;
}

}  // namespace argmesh
