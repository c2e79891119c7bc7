#include "core/graph/compute_graph.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "core/geometry/geodesic.h"
#include "core/graph/node_attributes.h"
#include "core/graph/node_relations.h"

namespace argmesh {
namespace {

absl::Status CheckLabels(std::string_view what, std::span<const int32_t> labels,
                         int num_samples, int num_nodes) {
  if (labels.size() != static_cast<size_t>(num_samples)) {
    return absl::InternalError(absl::StrFormat("%s: %d labels of %d samples",
                                               std::string(what), labels.size(),
                                               num_samples));
  }
  std::vector<char> seen(static_cast<size_t>(num_nodes), 0);
  for (const int32_t label : labels) {
    if (label < 0 || label >= num_nodes) {
      return absl::InternalError(absl::StrFormat(
          "%s: label %d of %d", std::string(what), label, num_nodes));
    }
    seen[static_cast<size_t>(label)] = 1;
  }
  for (size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] == 0) {
      return absl::InternalError(
          absl::StrFormat("%s: %d has no sample", std::string(what), i));
    }
  }
  return absl::OkStatus();
}

absl::Status CheckFeatures(const SurfaceAbstraction& surface) {
  const SurfaceFeatures& f = surface.features;
  const Eigen::Index n = surface.samples.V.rows();
  const bool sized =
      f.areas.size() == n && f.normals.rows() == n &&
      f.mean_curvature.size() == n && f.gauss_curvature.size() == n &&
      f.shape_diameter.size() == n && f.average_geodesic.size() == n &&
      f.wave_kernel.rows() == n && f.wave_kernel.cols() == 16;
  if (n == 0 || !sized) {
    return absl::InternalError(
        absl::StrFormat("surface features do not fit %d samples", n));
  }
  const bool finite =
      surface.samples.V.allFinite() && f.areas.allFinite() &&
      f.normals.allFinite() && f.mean_curvature.allFinite() &&
      f.gauss_curvature.allFinite() && f.shape_diameter.allFinite() &&
      f.average_geodesic.allFinite() && f.wave_kernel.allFinite();
  if (!finite) return absl::InternalError("surface features are not finite");
  return absl::OkStatus();
}

absl::Status CheckSurface(const SurfaceAbstraction& surface) {
  ARGMESH_RETURN_IF_ERROR(CheckFeatures(surface));
  const int n = surface.samples.num_vertices();
  const Decomposition& decomposition = surface.decomposition;
  ARGMESH_RETURN_IF_ERROR(CheckLabels("regions", decomposition.region_of_sample,
                                      n, decomposition.num_regions));
  for (const DecompositionLevel& level : decomposition.levels) {
    ARGMESH_RETURN_IF_ERROR(CheckLabels("components", level.component_of_region,
                                        decomposition.num_regions,
                                        level.num_components));
  }
  if (surface.num_uniform_cells == 0) return absl::OkStatus();
  return CheckLabels("uniform cells", surface.uniform_cell_of_sample, n,
                     surface.num_uniform_cells);
}

// Builds the levels of one surface; keeps what they share.
class LevelBuilder {
 public:
  explicit LevelBuilder(const SurfaceAbstraction& surface)
      : surface_(surface),
        terms_(surface),
        solver_(surface.geodesic_graph),
        regions_(CollectMembers(surface, surface.decomposition.region_of_sample,
                                surface.decomposition.num_regions)) {}

  absl::Status MeasureRegions(const StopToken& stop) {
    ARGMESH_ASSIGN_OR_RETURN(
        region_distances_,
        AverageGeodesicDistances(regions_,
                                 surface_.decomposition.region_of_sample,
                                 surface_.features.areas, solver_, stop));
    return absl::OkStatus();
  }

  ArgLevel BuildComponents(int index) {
    const DecompositionLevel& from =
        surface_.decomposition.levels[static_cast<size_t>(index)];
    const Eigen::MatrixXd distances =
        GroupDistances(region_distances_, regions_.area,
                       from.component_of_region, from.num_components);
    ArgLevel level = Build(surface_.decomposition.ComponentOfSample(index),
                           from.num_components, distances);
    level.threshold = from.threshold;
    level.count = from.count;
    for (size_t c = 0; index > 0 && c < level.nodes.size(); ++c) {
      level.nodes[c].parent = from.parent[c];
    }
    return level;
  }

  absl::StatusOr<ArgLevel> BuildUniform(const StopToken& stop) {
    const std::span<const int32_t> cells = surface_.uniform_cell_of_sample;
    const NodeMembers members =
        CollectMembers(surface_, cells, surface_.num_uniform_cells);
    ARGMESH_ASSIGN_OR_RETURN(
        const Eigen::MatrixXd distances,
        AverageGeodesicDistances(members, cells, surface_.features.areas,
                                 solver_, stop));
    ArgLevel level = Build(cells, surface_.num_uniform_cells, distances);
    SetUniformParents(cells, level);
    return level;
  }

 private:
  ArgLevel Build(std::span<const int32_t> node_of_sample, int num_nodes,
                 const Eigen::MatrixXd& distances) {
    ArgLevel level;
    const NodeMembers members =
        CollectMembers(surface_, node_of_sample, num_nodes);
    level.nodes = ComputeNodeAttributes(surface_, terms_, members,
                                        node_of_sample, solver_);
    level.edges = FindEdges(surface_.edge_graph, node_of_sample, distances);
    level.distances = PackDistances(distances);
    return level;
  }

  // Parents: the finest components with the largest part of each cell.
  void SetUniformParents(std::span<const int32_t> cells, ArgLevel& level) {
    const Decomposition& decomposition = surface_.decomposition;
    if (decomposition.levels.empty()) return;
    const int finest = static_cast<int>(decomposition.levels.size()) - 1;
    const std::vector<int32_t> component =
        decomposition.ComponentOfSample(finest);
    Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(
        level.num_nodes(), decomposition.levels.back().num_components);
    for (size_t v = 0; v < cells.size(); ++v) {
      shared(cells[v], component[v]) +=
          surface_.features.areas[static_cast<Eigen::Index>(v)];
    }
    for (size_t c = 0; c < level.nodes.size(); ++c) {
      Eigen::Index parent = 0;
      shared.row(static_cast<Eigen::Index>(c)).maxCoeff(&parent);
      level.nodes[c].parent = static_cast<int32_t>(parent);
    }
  }

  const SurfaceAbstraction& surface_;
  SampleTerms terms_;
  GeodesicSolver solver_;
  NodeMembers regions_;
  Eigen::MatrixXd region_distances_;
};

std::vector<ArgMode> CopyModes(const SurfaceAbstraction& surface) {
  const Decomposition& decomposition = surface.decomposition;
  std::vector<ArgMode> modes;
  if (decomposition.levels.empty()) return modes;
  const std::vector<int32_t>& component =
      decomposition.levels.back().component_of_region;
  for (const Mode& mode : decomposition.modes) {
    ArgMode copy;
    const Eigen::Vector3d at = surface.samples.vertex(mode.sample);
    copy.position = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                     static_cast<float>(at.z())};
    copy.window = mode.window;
    copy.repeatability = mode.repeatability;
    copy.density = mode.density;
    copy.offset = mode.offset;
    copy.node = component[static_cast<size_t>(mode.region)];
    modes.push_back(copy);
  }
  return modes;
}

}  // namespace

absl::StatusOr<ShapeGraph> BuildShapeGraph(const SurfaceAbstraction& surface,
                                           const StopToken& stop,
                                           DecompositionKind kind) {
  ARGMESH_RETURN_IF_ERROR(CheckSurface(surface));
  ShapeGraph graph;
  LevelBuilder builder(surface);
  ARGMESH_RETURN_IF_ERROR(builder.MeasureRegions(stop));
  for (size_t l = 0; l < surface.decomposition.levels.size(); ++l) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    graph.levels.push_back(builder.BuildComponents(static_cast<int>(l)));
  }
  if (surface.num_uniform_cells > 0) {
    ARGMESH_ASSIGN_OR_RETURN(graph.uniform, builder.BuildUniform(stop));
  }
  graph.modes = CopyModes(surface);
  const Eigen::Vector3d& centroid = surface.transform.centroid;
  graph.centroid = {centroid.x(), centroid.y(), centroid.z()};
  graph.scale = surface.transform.scale;
  graph.num_components = surface.edge_graph.num_components;
  graph.decomposition = static_cast<uint32_t>(kind);
  if (const absl::Status status = CheckShapeGraph(graph); !status.ok()) {
    return absl::InternalError(std::string(status.message()));
  }
  return graph;
}

FaceLabels BuildFaceLabels(const SurfaceAbstraction& surface) {
  const Decomposition& decomposition = surface.decomposition;
  FaceLabels labels;
  std::vector<int32_t> component;
  if (!decomposition.levels.empty()) {
    component = decomposition.ComponentOfSample(
        static_cast<int>(decomposition.levels.size()) - 1);
  }
  const auto label_of = [](std::span<const int32_t> of_sample, int32_t sample) {
    return sample < 0 || of_sample.empty()
               ? int16_t{-1}
               : static_cast<int16_t>(of_sample[static_cast<size_t>(sample)]);
  };
  for (const int32_t sample : surface.sample_of_face) {
    labels.component.push_back(label_of(component, sample));
    if (surface.num_uniform_cells > 0) {
      labels.uniform.push_back(
          label_of(surface.uniform_cell_of_sample, sample));
    }
  }
  return labels;
}

absl::StatusOr<ComputedGraph> ComputeShapeGraph(
    const TriangleMesh& mesh, const AbstractionOptions& options,
    const StopToken& stop) {
  ARGMESH_ASSIGN_OR_RETURN(SurfaceAbstraction surface,
                           AbstractSurface(mesh, options, stop));
  const absl::Time start = absl::Now();
  ComputedGraph computed;
  ARGMESH_ASSIGN_OR_RETURN(
      computed.graph,
      BuildShapeGraph(surface, stop, options.decomposition.kind));
  computed.labels = BuildFaceLabels(surface);
  computed.repaired = std::move(surface.repaired);
  computed.report = surface.report;
  computed.abstraction_times = surface.times;
  computed.attribute_time = absl::Now() - start;
  return computed;
}

}  // namespace argmesh
