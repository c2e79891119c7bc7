#include "server/rpc/convert_graph.h"

#include <algorithm>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_collection.h"
#include "server/rpc/convert_mesh.h"

namespace argmesh {
namespace {

using FloatField = google::protobuf::RepeatedField<float>;

template <typename Floats>
void CopyOut(const Floats& values, FloatField* out) {
  out->Assign(values.begin(), values.end());
}

absl::Status GraphInvalid(std::string_view field, std::string_view why) {
  return MakeError(
      ErrorReason::kGraphInvalid,
      absl::StrFormat("%s: %s", std::string(field), std::string(why)),
      {{"field", std::string(field)}});
}

template <size_t size>
absl::Status CopyIn(std::string_view field, const FloatField& values,
                    std::array<float, size>* out) {
  if (values.size() != static_cast<int>(size)) {
    return GraphInvalid(
        field, absl::StrFormat("%d values instead of %d", values.size(), size));
  }
  std::copy(values.begin(), values.end(), out->begin());
  return absl::OkStatus();
}

void NodeToProto(const ArgNode& node, v1::GraphNode* out) {
  out->set_normal_deviation(node.tuple.normal_deviation);
  out->set_gauss_deviation(node.tuple.gauss_deviation);
  out->set_gauss_mean(node.tuple.gauss_mean);
  out->set_mean_deviation(node.tuple.mean_deviation);
  out->set_mean_mean(node.tuple.mean_mean);
  out->set_geodesic_deviation(node.tuple.geodesic_deviation);
  out->set_geodesic_mean(node.tuple.geodesic_mean);
  out->set_log2_relative_area(node.tuple.log2_relative_area);
  v1::NodeHistograms& histograms = *out->mutable_histograms();
  CopyOut(node.histograms.shape_diameter, histograms.mutable_shape_diameter());
  CopyOut(node.histograms.average_geodesic,
          histograms.mutable_average_geodesic());
  CopyOut(node.histograms.shape_index, histograms.mutable_shape_index());
  CopyOut(node.histograms.curvedness, histograms.mutable_curvedness());
  CopyOut(node.histograms.internal_distance,
          histograms.mutable_internal_distance());
  CopyOut(node.histograms.outer_distance, histograms.mutable_outer_distance());
  CopyOut(node.histograms.relative_diameter,
          histograms.mutable_relative_diameter());
  CopyOut(node.wave_kernel, out->mutable_wave_kernel());
  out->set_area(node.area);
  *out->mutable_center() = ToVector(node.center);
  out->set_parent(node.parent);
}

v1::GraphLevel LevelToProto(const ArgLevel& level, const std::string& name) {
  v1::GraphLevel out;
  out.set_name(name);
  out.set_threshold(level.threshold);
  out.set_count(level.count);
  for (const ArgNode& node : level.nodes) NodeToProto(node, out.add_nodes());
  for (const ArgEdge& edge : level.edges) {
    v1::GraphEdge& added = *out.add_edges();
    added.set_a(edge.a);
    added.set_b(edge.b);
    added.set_geodesic(edge.geodesic);
    added.set_border_length(edge.border_length);
  }
  CopyOut(level.distances, out.mutable_distances());
  return out;
}

std::array<float, 3> ToFloats(const v1::Vector3& vector) {
  return {static_cast<float>(vector.x()), static_cast<float>(vector.y()),
          static_cast<float>(vector.z())};
}

absl::Status HistogramsFromProto(const std::string& field,
                                 const v1::NodeHistograms& from,
                                 NodeHistograms* out) {
  ARGMESH_RETURN_IF_ERROR(CopyIn(field + ".shape_diameter",
                                 from.shape_diameter(), &out->shape_diameter));
  ARGMESH_RETURN_IF_ERROR(CopyIn(field + ".average_geodesic",
                                 from.average_geodesic(),
                                 &out->average_geodesic));
  ARGMESH_RETURN_IF_ERROR(
      CopyIn(field + ".shape_index", from.shape_index(), &out->shape_index));
  ARGMESH_RETURN_IF_ERROR(
      CopyIn(field + ".curvedness", from.curvedness(), &out->curvedness));
  ARGMESH_RETURN_IF_ERROR(CopyIn(field + ".internal_distance",
                                 from.internal_distance(),
                                 &out->internal_distance));
  ARGMESH_RETURN_IF_ERROR(CopyIn(field + ".outer_distance",
                                 from.outer_distance(), &out->outer_distance));
  return CopyIn(field + ".relative_diameter", from.relative_diameter(),
                &out->relative_diameter);
}

absl::StatusOr<ArgNode> NodeFromProto(const std::string& field,
                                      const v1::GraphNode& from) {
  ArgNode out;
  out.tuple = {.normal_deviation = from.normal_deviation(),
               .gauss_deviation = from.gauss_deviation(),
               .gauss_mean = from.gauss_mean(),
               .mean_deviation = from.mean_deviation(),
               .mean_mean = from.mean_mean(),
               .geodesic_deviation = from.geodesic_deviation(),
               .geodesic_mean = from.geodesic_mean(),
               .log2_relative_area = from.log2_relative_area()};
  ARGMESH_RETURN_IF_ERROR(HistogramsFromProto(
      field + ".histograms", from.histograms(), &out.histograms));
  ARGMESH_RETURN_IF_ERROR(
      CopyIn(field + ".wave_kernel", from.wave_kernel(), &out.wave_kernel));
  out.area = from.area();
  out.center = ToFloats(from.center());
  out.parent = from.parent();
  return out;
}

absl::StatusOr<ArgLevel> LevelFromProto(const std::string& field,
                                        const v1::GraphLevel& from) {
  ArgLevel out;
  out.threshold = from.threshold();
  out.count = from.count();
  out.nodes.reserve(static_cast<size_t>(from.nodes_size()));
  for (int i = 0; i < from.nodes_size(); ++i) {
    ARGMESH_ASSIGN_OR_RETURN(
        ArgNode node,
        NodeFromProto(absl::StrCat(field, ".nodes[", i, "]"), from.nodes(i)));
    out.nodes.push_back(node);
  }
  for (const v1::GraphEdge& edge : from.edges()) {
    out.edges.push_back({.a = edge.a(),
                         .b = edge.b(),
                         .geodesic = edge.geodesic(),
                         .border_length = edge.border_length()});
  }
  out.distances.assign(from.distances().begin(), from.distances().end());
  return out;
}

ArgMode ModeFromProto(const v1::GraphMode& from) {
  return {.position = ToFloats(from.position()),
          .window = from.window(),
          .repeatability = from.repeatability(),
          .density = from.density(),
          .offset = from.offset(),
          .node = from.node()};
}

uint32_t KindFromProto(v1::DecompositionKind kind) {
  for (const DecompositionKind known :
       {DecompositionKind::kBiharmonic, DecompositionKind::kNormalCurvature,
        DecompositionKind::kVoronoi, DecompositionKind::kGiven}) {
    if (ToProto(known) == kind) return static_cast<uint32_t>(known);
  }
  return static_cast<uint32_t>(DecompositionKind::kBiharmonic);
}

}  // namespace

v1::ShapeGraph ToProto(const ShapeGraph& graph) {
  v1::ShapeGraph out;
  out.set_version(kShapeGraphVersion);
  const std::vector<std::string> names = LevelNames(graph);
  for (size_t i = 0; i < graph.levels.size(); ++i) {
    *out.add_levels() = LevelToProto(graph.levels[i], names[i]);
  }
  if (!graph.uniform.nodes.empty()) {
    *out.mutable_uniform() = LevelToProto(graph.uniform, names.back());
  }
  for (const ArgMode& mode : graph.modes) {
    v1::GraphMode& added = *out.add_modes();
    *added.mutable_position() = ToVector(mode.position);
    added.set_window(mode.window);
    added.set_repeatability(mode.repeatability);
    added.set_density(mode.density);
    added.set_offset(mode.offset);
    added.set_node(mode.node);
  }
  *out.mutable_centroid() = ToVector(graph.centroid);
  out.set_scale(graph.scale);
  out.set_connected_components(graph.num_components);
  out.set_decomposition(
      ToProto(static_cast<DecompositionKind>(graph.decomposition)));
  return out;
}

absl::StatusOr<ShapeGraph> FromProto(std::string_view field,
                                     const v1::ShapeGraph& graph) {
  if (graph.version() != kShapeGraphVersion) {
    return MakeError(
        ErrorReason::kGraphVersionMismatch,
        absl::StrFormat("%s: a graph of version %d; this server compares "
                        "version %d",
                        std::string(field), graph.version(),
                        kShapeGraphVersion),
        {{"field", std::string(field)},
         {"version", absl::StrCat(graph.version())}});
  }
  ShapeGraph out;
  for (int i = 0; i < graph.levels_size(); ++i) {
    ARGMESH_ASSIGN_OR_RETURN(
        ArgLevel level,
        LevelFromProto(absl::StrFormat("%s.levels[%d]", std::string(field), i),
                       graph.levels(i)));
    out.levels.push_back(std::move(level));
  }
  if (graph.has_uniform()) {
    ARGMESH_ASSIGN_OR_RETURN(
        out.uniform,
        LevelFromProto(std::string(field) + ".uniform", graph.uniform()));
  }
  for (const v1::GraphMode& mode : graph.modes()) {
    out.modes.push_back(ModeFromProto(mode));
  }
  out.centroid = {graph.centroid().x(), graph.centroid().y(),
                  graph.centroid().z()};
  out.scale = graph.scale();
  out.num_components = graph.connected_components();
  out.decomposition = KindFromProto(graph.decomposition());
  if (const absl::Status checked = CheckShapeGraph(out); !checked.ok()) {
    return GraphInvalid(field, std::string(checked.message()));
  }
  return out;
}

v1::FaceLabels ToProto(const ShapeGraph& graph, const FaceLabels& labels,
                       int level, const FaceRange& range) {
  const int num_levels = static_cast<int>(graph.levels.size());
  const bool uniform = level >= num_levels;
  // Only the range is mapped to the level: the whole may be long.
  FaceLabels part;
  const std::vector<int16_t>& all = uniform ? labels.uniform : labels.component;
  const auto total = static_cast<int64_t>(all.size());
  const int64_t first = std::clamp<int64_t>(range.first_face, 0, total);
  const int64_t last =
      first + std::clamp<int64_t>(range.count, 0, total - first);
  std::vector<int16_t> values(all.begin() + first, all.begin() + last);
  if (!uniform && level < num_levels - 1) {
    part.component = std::move(values);
    values = LabelsAtLevel(graph, part, level);
  }
  v1::FaceLabels out;
  out.set_level(LevelNames(graph)[static_cast<size_t>(level)]);
  out.set_level_index(level);
  out.set_first_face(first);
  out.set_total_faces(total);
  out.mutable_labels()->Assign(values.begin(), values.end());
  return out;
}

int NumLabelLevels(const ShapeGraph& graph, const FaceLabels& labels) {
  const int levels = static_cast<int>(graph.levels.size());
  return !labels.uniform.empty() && !graph.uniform.nodes.empty() ? levels + 1
                                                                 : levels;
}

}  // namespace argmesh
