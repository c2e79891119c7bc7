#include "client/cli/json.h"

#include <google/protobuf/util/time_util.h>

#include <map>
#include <string>

#include "client/error_status.h"
#include "client/resource_name.h"

namespace argmesh {
namespace {

using google::protobuf::util::TimeUtil;

// "PREFIX_SOME_NAME" as "some-name".
std::string EnumName(std::string name, size_t prefix) {
  name.erase(0, prefix);
  for (char& c : name) {
    c = c == '_' ? '-' : static_cast<char>(std::tolower(c));
  }
  return name;
}

// Protobuf's map has no order of its own.
Json Metadata(const google::protobuf::Map<std::string, std::string>& entries) {
  Json json = Json::object();
  for (const auto& [key, value] :
       std::map<std::string, std::string>(entries.begin(), entries.end())) {
    json[key] = value;
  }
  return json;
}

Json ToJson(const v1::Vector3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json ToJson(const v1::MeshReport& report) {
  return {{"vertices", report.vertices()},
          {"faces", report.faces()},
          {"components", report.components()},
          {"boundary_edges", report.boundary_edges()},
          {"nonmanifold_edges", report.nonmanifold_edges()},
          {"nonmanifold_vertices", report.nonmanifold_vertices()},
          {"unused_vertices", report.unused_vertices()},
          {"area", report.area()},
          {"bounding_box_min", ToJson(report.bounding_box_min())},
          {"bounding_box_max", ToJson(report.bounding_box_max())},
          {"euler_characteristic", report.euler_characteristic()},
          {"welded_vertices", report.welded_vertices()},
          {"degenerate_faces_dropped", report.degenerate_faces_dropped()},
          {"duplicate_faces_dropped", report.duplicate_faces_dropped()},
          {"faces_flipped", report.faces_flipped()},
          {"vertices_split", report.vertices_split()},
          {"sample_vertices", report.sample_vertices()},
          {"smoothed", report.smoothed()}};
}

Json ToJson(const v1::Mesh& mesh) {
  return {{"format", FormatName(mesh.format())},
          {"size_bytes", mesh.size_bytes()},
          {"sha256", mesh.sha256()},
          {"stored", mesh.stored()},
          {"report", ToJson(mesh.report())}};
}

Json ToJson(const v1::GraphSummary& summary) {
  Json levels = Json::array();
  for (const v1::LevelSummary& level : summary.levels()) {
    levels.push_back({{"level", level.name()},
                      {"nodes", level.nodes()},
                      {"edges", level.edges()}});
  }
  return {{"version", summary.version()},
          {"levels", std::move(levels)},
          {"modes", summary.modes()}};
}

Json ToJson(const v1::GraphNode& node) {
  const v1::NodeHistograms& h = node.histograms();
  Json json = {{"area", node.area()},
               {"center", ToJson(node.center())},
               {"parent", node.parent()},
               {"normal_deviation", node.normal_deviation()},
               {"gauss_deviation", node.gauss_deviation()},
               {"gauss_mean", node.gauss_mean()},
               {"mean_deviation", node.mean_deviation()},
               {"mean_mean", node.mean_mean()},
               {"geodesic_deviation", node.geodesic_deviation()},
               {"geodesic_mean", node.geodesic_mean()},
               {"log2_relative_area", node.log2_relative_area()}};
  json["histograms"] = {{"shape_diameter", h.shape_diameter()},
                        {"average_geodesic", h.average_geodesic()},
                        {"shape_index", h.shape_index()},
                        {"curvedness", h.curvedness()},
                        {"internal_distance", h.internal_distance()},
                        {"outer_distance", h.outer_distance()},
                        {"relative_diameter", h.relative_diameter()}};
  json["wave_kernel"] = node.wave_kernel();
  return json;
}

Json ToJson(const v1::GraphLevel& level) {
  Json nodes = Json::array();
  for (const v1::GraphNode& node : level.nodes()) nodes.push_back(ToJson(node));
  Json edges = Json::array();
  for (const v1::GraphEdge& edge : level.edges()) {
    edges.push_back({{"a", edge.a()},
                     {"b", edge.b()},
                     {"geodesic", edge.geodesic()},
                     {"border_length", edge.border_length()}});
  }
  return {{"level", level.name()},     {"threshold", level.threshold()},
          {"count", level.count()},    {"nodes", std::move(nodes)},
          {"edges", std::move(edges)}, {"distances", level.distances()}};
}

}  // namespace

Json ErrorToJson(const absl::Status& status) {
  return {{"code", absl::StatusCodeToString(status.code())},
          {"reason", ErrorReason(status)},
          {"message", ErrorText(status)}};
}

Json ToJson(const v1::Collection& collection) {
  const v1::CollectionSettings& settings = collection.settings();
  Json keys = Json::object();
  for (const v1::MetadataKey& key : collection.metadata_keys()) {
    keys[key.key()] = EnumName(v1::MetadataType_Name(key.type()),
                               std::string("METADATA_TYPE_").size());
  }
  return {{"collection", ResourceId(collection.name())},
          {"display_name", collection.display_name()},
          {"shape_count", collection.shape_count()},
          {"decomposition", DecompositionName(settings.decomposition())},
          {"vertex_budget", settings.vertex_budget()},
          {"uniform_cells", settings.uniform_cells()},
          {"store_meshes", settings.store_meshes()},
          {"metadata_keys", std::move(keys)},
          {"graph_version", collection.graph_version()},
          {"generation", collection.generation()},
          {"create_time", TimeUtil::ToString(collection.create_time())},
          {"update_time", TimeUtil::ToString(collection.update_time())},
          {"etag", collection.etag()}};
}

Json ToJson(const v1::Shape& shape) {
  Json json = {{"shape", ResourceId(shape.name())},
               {"name", shape.name()},
               {"display_name", shape.display_name()},
               {"source_uri", shape.source_uri()},
               {"class", ClassOf(shape)},
               {"metadata", Metadata(shape.metadata())},
               {"state", EnumName(v1::ShapeState_Name(shape.state()),
                                  std::string("SHAPE_STATE_").size())},
               {"mesh", ToJson(shape.mesh())},
               {"create_time", TimeUtil::ToString(shape.create_time())},
               {"update_time", TimeUtil::ToString(shape.update_time())},
               {"generation", shape.generation()},
               {"etag", shape.etag()}};
  if (shape.has_graph()) json["graph"] = ToJson(shape.graph());
  if (shape.has_error()) json["error"] = ErrorToJson(ToStatus(shape.error()));
  return json;
}

Json ToJson(const v1::ShapeGraph& graph, const std::string& level) {
  Json levels = Json::array();
  for (const v1::GraphLevel& l : graph.levels()) {
    if (level.empty() || l.name() == level) levels.push_back(ToJson(l));
  }
  if (graph.has_uniform() &&
      (level.empty() || graph.uniform().name() == level)) {
    levels.push_back(ToJson(graph.uniform()));
  }
  Json modes = Json::array();
  for (const v1::GraphMode& mode : graph.modes()) {
    modes.push_back({{"position", ToJson(mode.position())},
                     {"window", mode.window()},
                     {"repeatability", mode.repeatability()},
                     {"density", mode.density()},
                     {"offset", mode.offset()},
                     {"node", mode.node()}});
  }
  return {{"version", graph.version()},
          {"decomposition", DecompositionName(graph.decomposition())},
          {"connected_components", graph.connected_components()},
          {"centroid", ToJson(graph.centroid())},
          {"scale", graph.scale()},
          {"levels", std::move(levels)},
          {"modes", std::move(modes)}};
}

Json ToJson(const v1::Match& match) {
  Json level_scores = Json::object();
  for (const v1::LevelScore& level : match.level_scores()) {
    level_scores[level.level()] = level.score();
  }
  Json pairs = Json::array();
  for (const v1::ComponentPair& pair : match.component_pairs()) {
    pairs.push_back({{"query_node", pair.query_node()},
                     {"target_node", pair.target_node()},
                     {"similarity", pair.similarity()}});
  }
  Json json = {{"shape", ResourceId(match.shape().name())},
               {"score", match.score()},
               {"level_scores", std::move(level_scores)},
               {"best_level", match.best_level()},
               {"query_coverage", match.query_coverage()},
               {"target_coverage", match.target_coverage()},
               {"class", ClassOf(match.shape())},
               {"metadata", Metadata(match.shape().metadata())},
               {"source_uri", match.shape().source_uri()},
               {"best_query_level", match.best_query_level()},
               {"best_target_level", match.best_target_level()},
               {"component_pairs", std::move(pairs)}};
  if (match.handedness() != v1::HANDEDNESS_UNSPECIFIED) {
    json["mirrored"] = match.handedness() == v1::HANDEDNESS_MIRRORED;
  }
  if (match.has_containment()) {
    const v1::Containment& containment = match.containment();
    json["containment"] = {{"verified", containment.verified()},
                           {"tied", containment.tied()},
                           {"window_score", containment.window_score()},
                           {"surface_score", containment.surface_score()},
                           {"inside_out", containment.inside_out()},
                           {"transform", containment.transform()}};
    Json& others = json["containment"]["other_places"] = Json::array();
    for (const v1::Placement& place : containment.other_places()) {
      others.push_back(place.transform());
    }
  }
  if (match.has_explanation()) {
    Json terms = Json::array();
    for (const v1::ScoreTerm& term : match.explanation().terms()) {
      terms.push_back({{"term", term.name()},
                       {"value", term.value()},
                       {"weight", term.weight()},
                       {"contribution", term.contribution()}});
    }
    json["explanation"] = {
        {"candidate_rank", match.explanation().candidate_rank()},
        {"terms", std::move(terms)}};
  }
  return json;
}

Json ToJson(const v1::SearchStats& stats) {
  Json stages = Json::object();
  for (const v1::StageTime& stage : stats.stage_times()) {
    stages[stage.stage()] =
        static_cast<double>(TimeUtil::DurationToMicroseconds(stage.elapsed())) *
        1e-6;
  }
  return {{"generation", stats.generation()},
          {"shapes_considered", stats.shapes_considered()},
          {"candidates_ranked", stats.candidates_ranked()},
          {"shapes_unusable", stats.shapes_unusable()},
          {"exhaustive", stats.exhaustive()},
          {"stage_seconds", std::move(stages)}};
}

Json ToJson(const v1::GetServerInfoResponse& info) {
  const v1::ServerLimits& limits = info.limits();
  return {{"version", info.version()},
          {"graph_version", info.graph_version()},
          {"start_time", TimeUtil::ToString(info.start_time())},
          {"uptime_seconds", TimeUtil::DurationToSeconds(info.uptime())},
          {"collections", info.collection_count()},
          {"shapes", info.shape_count()},
          {"calls_in_flight", info.calls_in_flight()},
          {"draining", info.draining()},
          {"limits",
           {{"max_mesh_bytes", limits.max_mesh_bytes()},
            {"max_message_bytes", limits.max_message_bytes()},
            {"max_inflight_searches", limits.max_inflight_searches()},
            {"max_inflight_uploads", limits.max_inflight_uploads()},
            {"max_inflight_ingests", limits.max_inflight_ingests()},
            {"max_page_size", limits.max_page_size()},
            {"max_search_limit", limits.max_search_limit()}}}};
}

std::string ClassOf(const v1::Shape& shape) {
  const auto entry = shape.metadata().find("class");
  return entry == shape.metadata().end() ? "" : entry->second;
}

std::string DecompositionName(v1::DecompositionKind kind) {
  return EnumName(v1::DecompositionKind_Name(kind),
                  std::string("DECOMPOSITION_KIND_").size());
}

std::string FormatName(v1::MeshFormat format) {
  return EnumName(v1::MeshFormat_Name(format),
                  std::string("MESH_FORMAT_").size());
}

}  // namespace argmesh
