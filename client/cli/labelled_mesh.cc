#include "client/cli/labelled_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

#include "absl/strings/str_format.h"
#include "client/cli/session.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_format.h"

namespace argmesh {
namespace {

MeshFormat FormatOf(v1::MeshFormat format) {
  switch (format) {
    case v1::MESH_FORMAT_OFF:
      return MeshFormat::kOff;
    case v1::MESH_FORMAT_OBJ:
      return MeshFormat::kObj;
    case v1::MESH_FORMAT_PLY:
      return MeshFormat::kPly;
    case v1::MESH_FORMAT_STL:
      return MeshFormat::kStl;
    default:
      return MeshFormat::kUnknown;
  }
}

const v1::FaceLabels* FindLabels(const LabelledMesh& shape, int level) {
  const auto found = std::find_if(
      shape.labels.begin(), shape.labels.end(),
      [level](const v1::FaceLabels& l) { return l.level_index() == level; });
  return found == shape.labels.end() ? nullptr : &*found;
}

// The node of `level` that a node of the finest level lies in; -1 for none.
int32_t AncestorAt(const v1::ShapeGraph& graph, int level, int32_t node) {
  for (int l = graph.levels_size() - 1; l > level && node >= 0; --l) {
    if (node >= graph.levels(l).nodes_size()) return -1;
    node = graph.levels(l).nodes(node).parent();
  }
  return node;
}

// What a comparison says about one side; a stored shape is fetched.
absl::StatusOr<LabelledMesh> FetchSide(Client& client,
                                       const std::string& collection,
                                       const v1::ShapeReference& reference,
                                       v1::ComparedGraph& compared) {
  if (reference.has_shape()) {
    return FetchLabelledMesh(client, collection, ResourceId(reference.shape()));
  }
  LabelledMesh side;
  ARGMESH_ASSIGN_OR_RETURN(side.mesh, ReadMesh(reference.mesh()));
  side.graph.Swap(compared.mutable_graph());
  side.labels.assign(compared.face_labels().begin(),
                     compared.face_labels().end());
  return side;
}

}  // namespace

std::vector<const v1::GraphLevel*> LevelsOf(const v1::ShapeGraph& graph) {
  std::vector<const v1::GraphLevel*> levels;
  for (const v1::GraphLevel& level : graph.levels()) levels.push_back(&level);
  if (graph.has_uniform()) levels.push_back(&graph.uniform());
  return levels;
}

absl::StatusOr<int> FindLevel(const v1::ShapeGraph& graph,
                              const std::string& name) {
  const auto levels = LevelsOf(graph);
  std::string names;
  for (size_t i = 0; i < levels.size(); ++i) {
    if (levels[i]->name() == name) return static_cast<int>(i);
    names += " " + levels[i]->name();
  }
  return UsageError("--level " + name + ": the shape has" + names);
}

absl::StatusOr<std::vector<int32_t>> ComponentsOfFaces(
    const LabelledMesh& shape, int level) {
  const v1::FaceLabels* own = FindLabels(shape, level);
  const v1::FaceLabels* labels =
      own != nullptr ? own : FindLabels(shape, shape.graph.levels_size() - 1);
  if (labels == nullptr) {
    return absl::DataLossError(
        absl::StrFormat("%s: the server sent no face labels", shape.caption));
  }
  if (labels->labels_size() != shape.mesh.num_faces()) {
    return absl::DataLossError(absl::StrFormat(
        "%s: labels of %d triangles, the mesh has %d", shape.caption,
        labels->labels_size(), shape.mesh.num_faces()));
  }
  std::vector<int32_t> components(labels->labels().begin(),
                                  labels->labels().end());
  if (own == nullptr) {
    for (int32_t& component : components) {
      component = AncestorAt(shape.graph, level, component);
    }
  }
  return components;
}

absl::StatusOr<TriangleMesh> FetchMesh(Client& client,
                                       const std::string& name) {
  ARGMESH_ASSIGN_OR_RETURN(const DownloadedMesh file,
                           client.DownloadMesh(name));
  ARGMESH_ASSIGN_OR_RETURN(ParsedMesh parsed,
                           ParseMesh(file.bytes, FormatOf(file.format)));
  return std::move(parsed.mesh);
}

absl::StatusOr<TriangleMesh> ReadMesh(const v1::MeshContent& content) {
  ARGMESH_ASSIGN_OR_RETURN(
      ParsedMesh parsed, ParseMesh(content.data(), FormatOf(content.format())));
  return std::move(parsed.mesh);
}

absl::StatusOr<LabelledMesh> FetchLabelledMesh(Client& client,
                                               const std::string& collection,
                                               const std::string& shape_id) {
  const std::string name = ShapeName(collection, shape_id);
  LabelledMesh shape;
  ARGMESH_ASSIGN_OR_RETURN(ShapeGraphWithLabels answer,
                           client.GetShapeGraph(name, v1::FACE_LABEL_VIEW_ALL));
  ARGMESH_ASSIGN_OR_RETURN(shape.mesh, FetchMesh(client, name));
  shape.graph.Swap(&answer.graph);
  shape.labels = std::move(answer.face_labels);
  shape.caption = shape_id;
  return shape;
}

absl::StatusOr<std::vector<int32_t>> PairsOfFaces(const MatchedMeshes& matched,
                                                  bool query_side) {
  const v1::Match& match = matched.match;
  const LabelledMesh& side = query_side ? matched.query : matched.target;
  ARGMESH_ASSIGN_OR_RETURN(
      std::vector<int32_t> faces,
      ComponentsOfFaces(side, query_side ? match.best_query_level()
                                         : match.best_target_level()));
  std::map<int32_t, int32_t> pair_of_node;
  for (int i = 0; i < match.component_pairs_size(); ++i) {
    const v1::ComponentPair& pair = match.component_pairs(i);
    pair_of_node[query_side ? pair.query_node() : pair.target_node()] = i;
  }
  for (int32_t& face : faces) {
    const auto found = pair_of_node.find(face);
    face = found == pair_of_node.end() ? -1 : found->second;
  }
  return faces;
}

absl::StatusOr<MatchedMeshes> FetchMatch(
    Client& client, const v1::CompareShapesRequest& request) {
  ARGMESH_ASSIGN_OR_RETURN(v1::CompareShapesResponse response,
                           client.CompareShapes(request));
  const std::string collection = ResourceId(request.parent());
  MatchedMeshes matched;
  matched.match = response.match();
  ARGMESH_ASSIGN_OR_RETURN(matched.query,
                           FetchSide(client, collection, request.query(),
                                     *response.mutable_query()));
  ARGMESH_ASSIGN_OR_RETURN(matched.target,
                           FetchSide(client, collection, request.target(),
                                     *response.mutable_target()));
  return matched;
}

}  // namespace argmesh
