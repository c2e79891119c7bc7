#include "core/abstraction/surface_abstraction.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/abstraction/voronoi_regions.h"
#include "core/base/status_macros.h"
#include "core/base/stopwatch.h"
#include "core/mesh/mesh_canonical.h"

namespace argmesh {
namespace {

constexpr int kMaxUniformCells = 1000;
// Components so many that they cannot be collapsed to the budget are tried
// again with coarser welding, in units of sqrt(area), before samples beyond
// this multiple of the budget are accepted.
constexpr double kCoarseWelds[] = {1e-3, 1e-2};
constexpr int kMaxBudgetMultiple = 2;

struct Samples {
  RepairedMesh repaired;
  CanonicalMesh canonical;  // of the repaired mesh
  ResampledMesh resampled;  // of the canonical one
};

absl::StatusOr<Samples> SampleSurface(const TriangleMesh& mesh,
                                      const AbstractionOptions& options,
                                      const StopToken& stop,
                                      AbstractionTimes& times) {
  Stopwatch stopwatch;
  const int most = kMaxBudgetMultiple * options.resample.vertex_budget;
  RepairOptions repair = options.repair;
  Samples samples;
  for (size_t attempt = 0;; ++attempt) {
    ARGMESH_ASSIGN_OR_RETURN(samples.repaired, RepairMesh(mesh, repair));
    ARGMESH_ASSIGN_OR_RETURN(samples.canonical,
                             CanonicalizeMesh(samples.repaired.mesh));
    times.repair += stopwatch.Lap();
    ARGMESH_ASSIGN_OR_RETURN(
        samples.resampled,
        ResampleMesh(samples.canonical.mesh, options.resample, stop));
    times.resample += stopwatch.Lap();
    const int count = samples.resampled.mesh.num_vertices();
    if (count <= most || attempt == std::size(kCoarseWelds)) return samples;
    repair.weld_distance =
        std::max(repair.weld_distance, kCoarseWelds[attempt]);
  }
}

// The mesh's faces are numbered as uploaded; repair dropped some of them.
std::vector<int32_t> MapFacesToSamples(const TriangleMesh& mesh,
                                       const Samples& samples) {
  std::vector<int32_t> sample_of_face(static_cast<size_t>(mesh.num_faces()),
                                      -1);
  for (size_t f = 0; f < samples.canonical.source_face.size(); ++f) {
    const auto repaired_face =
        static_cast<size_t>(samples.canonical.source_face[f]);
    sample_of_face[static_cast<size_t>(
        samples.repaired.source_face[repaired_face])] =
        samples.resampled.sample_of_face[f];
  }
  return sample_of_face;
}

// From the repaired mesh's units to the samples, without the turn to the
// canonical axes.
UnitAreaTransform ComposeTransform(const CanonicalMesh& canonical,
                                   const UnitAreaTransform& unit) {
  const UnitAreaTransform& first = canonical.unit_area;
  return {.centroid = first.centroid + canonical.rotation.transpose() *
                                           unit.centroid / first.scale,
          .scale = first.scale * unit.scale};
}

// Everything up to here saw the surface in its canonical axes, whichever way
// the input was turned; what leaves is turned like the input.
void TurnBack(const Eigen::Matrix3d& rotation, SurfaceAbstraction& surface) {
  surface.samples.V = (surface.samples.V * rotation).eval();
  surface.features.normals = (surface.features.normals * rotation).eval();
}

// For each sample the label of most faces that map to it; samples without a
// face take their nearest labelled neighbour's.
std::vector<int32_t> LabelSamples(std::span<const int32_t> face_labels,
                                  std::span<const int32_t> sample_of_face,
                                  const SurfaceGraph& graph) {
  std::vector<std::pair<int32_t, int32_t>> votes;  // (sample, label)
  for (size_t f = 0; f < sample_of_face.size(); ++f) {
    if (sample_of_face[f] >= 0) {
      votes.emplace_back(sample_of_face[f], face_labels[f]);
    }
  }
  std::sort(votes.begin(), votes.end());
  std::vector<int32_t> labels(static_cast<size_t>(graph.num_vertices()), -1);
  std::vector<int32_t> most(labels.size(), 0);
  for (size_t first = 0, last = 0; first < votes.size(); first = last) {
    while (last < votes.size() && votes[last] == votes[first]) ++last;
    const auto sample = static_cast<size_t>(votes[first].first);
    const auto count = static_cast<int32_t>(last - first);
    if (count > most[sample]) {
      most[sample] = count;
      labels[sample] = votes[first].second;
    }
  }
  std::vector<int32_t> queue;
  for (size_t v = 0; v < labels.size(); ++v) {
    if (labels[v] >= 0) queue.push_back(static_cast<int32_t>(v));
  }
  for (size_t head = 0; head < queue.size(); ++head) {
    const auto v = static_cast<size_t>(queue[head]);
    for (int32_t link = graph.offsets[v]; link < graph.offsets[v + 1]; ++link) {
      const int32_t u = graph.targets[static_cast<size_t>(link)];
      if (labels[static_cast<size_t>(u)] >= 0) continue;
      labels[static_cast<size_t>(u)] = labels[v];
      queue.push_back(u);
    }
  }
  return labels;
}

double BoundaryShare(const MeshReport& report, const TriangleMesh& mesh) {
  const double boundary = static_cast<double>(report.boundary_edges) +
                          static_cast<double>(report.nonmanifold_edges);
  const double edges = (3.0 * mesh.num_faces() + boundary) / 2;
  return edges > 0 ? boundary / edges : 0;
}

absl::Status CheckOptions(const TriangleMesh& mesh,
                          const AbstractionOptions& options) {
  if (options.uniform_cells < 0 || options.uniform_cells > kMaxUniformCells) {
    return absl::InvalidArgumentError(
        absl::StrFormat("option uniform_cells is %d, must be 0 to %d",
                        options.uniform_cells, kMaxUniformCells));
  }
  if (options.decomposition.kind != DecompositionKind::kGiven) {
    return absl::OkStatus();
  }
  if (options.given_labels.size() != static_cast<size_t>(mesh.num_faces())) {
    return absl::InvalidArgumentError(
        absl::StrFormat("%d given labels for %d faces",
                        options.given_labels.size(), mesh.num_faces()));
  }
  const auto negative =
      std::find_if(options.given_labels.begin(), options.given_labels.end(),
                   [](int32_t label) { return label < 0; });
  if (negative != options.given_labels.end()) {
    return absl::InvalidArgumentError(
        absl::StrFormat("given label %d of face %d is negative", *negative,
                        negative - options.given_labels.begin()));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<SurfaceAbstraction> AbstractSurface(
    const TriangleMesh& mesh, const AbstractionOptions& options,
    const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(CheckOptions(mesh, options));
  ARGMESH_RETURN_IF_ERROR(CheckMesh(mesh));
  SurfaceAbstraction surface;
  ARGMESH_ASSIGN_OR_RETURN(Samples samples,
                           SampleSurface(mesh, options, stop, surface.times));
  Stopwatch stopwatch;
  surface.report = samples.repaired.report;
  surface.sample_of_face = MapFacesToSamples(mesh, samples);
  surface.samples = std::move(samples.resampled.mesh);
  surface.report.smoothed =
      BoundaryShare(surface.report, samples.repaired.mesh) <=
      options.max_boundary_share_smoothed;
  if (surface.report.smoothed) SmoothTaubin(surface.samples, options.smooth);
  surface.transform =
      ComposeTransform(samples.canonical, NormalizeToUnitArea(surface.samples));
  surface.repaired = std::move(samples.repaired.mesh);
  surface.report.sample_vertices = surface.samples.num_vertices();

  SurfaceGraphOptions edges_only;
  edges_only.diagonals = false;
  surface.edge_graph = BuildSurfaceGraph(surface.samples, edges_only);
  surface.geodesic_graph = BuildSurfaceGraph(surface.samples);
  ARGMESH_ASSIGN_OR_RETURN(
      surface.features,
      ComputeSurfaceFeatures(surface.samples, surface.geodesic_graph,
                             options.features, stop));
  surface.times.features = stopwatch.Lap();

  std::vector<int32_t> given;
  if (options.decomposition.kind == DecompositionKind::kGiven) {
    given = LabelSamples(options.given_labels, surface.sample_of_face,
                         surface.edge_graph);
  }
  const DecompositionInput input = {surface.samples, surface.features,
                                    surface.edge_graph, surface.geodesic_graph,
                                    given};
  ARGMESH_ASSIGN_OR_RETURN(
      surface.decomposition,
      DecomposeSurface(input, options.decomposition, stop));
  if (options.uniform_cells > 0) {
    FarthestPointCells cells = ComputeUniformCells(
        surface.samples, surface.geodesic_graph, options.uniform_cells);
    surface.num_uniform_cells = static_cast<int>(cells.seeds.size());
    surface.uniform_cell_of_sample = std::move(cells.cell_of_vertex);
  }
  TurnBack(samples.canonical.rotation, surface);
  surface.times.decomposition = stopwatch.Lap();
  return surface;
}

}  // namespace argmesh
