// A mesh with the component of every triangle at every level: what pictures
// are made of.
#ifndef ARGMESH_CLIENT_CLI_LABELLED_MESH_H_
#define ARGMESH_CLIENT_CLI_LABELLED_MESH_H_

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "argmesh/v1/graph.pb.h"
#include "argmesh/v1/match.pb.h"
#include "argmesh/v1/search_service.pb.h"
#include "client/client.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct LabelledMesh {
  TriangleMesh mesh;
  v1::ShapeGraph graph;
  std::vector<v1::FaceLabels> labels;  // at least the finest level
  std::string caption;                 // its id or file name
};

// The levels of a graph, coarse to fine, then "uniform" when it is there.
std::vector<const v1::GraphLevel*> LevelsOf(const v1::ShapeGraph& graph);

// Index of the level; the usage error lists the names there are.
absl::StatusOr<int> FindLevel(const v1::ShapeGraph& graph,
                              const std::string& name);

// The component of each triangle at a level (LevelsOf order); -1 for none.
// Levels without labels of their own follow from the finest one's parents.
// kDataLoss when labels and mesh do not fit together.
absl::StatusOr<std::vector<int32_t>> ComponentsOfFaces(
    const LabelledMesh& shape, int level);

// A stored shape: its mesh, graph and labels of all levels.
absl::StatusOr<LabelledMesh> FetchLabelledMesh(Client& client,
                                               const std::string& collection,
                                               const std::string& shape_id);

// The mesh of a stored shape alone.
absl::StatusOr<TriangleMesh> FetchMesh(Client& client, const std::string& name);
// The mesh of a message.
absl::StatusOr<TriangleMesh> ReadMesh(const v1::MeshContent& content);

// Two compared shapes and which components correspond.
struct MatchedMeshes {
  LabelledMesh query;
  LabelledMesh target;
  v1::Match match;
};

// For each triangle of a side the index of its pair in
// match.component_pairs(); -1 for none.
absl::StatusOr<std::vector<int32_t>> PairsOfFaces(const MatchedMeshes& matched,
                                                  bool query_side);

// Compares and fetches what a picture of the match needs; shapes and files.
absl::StatusOr<MatchedMeshes> FetchMatch(
    Client& client, const v1::CompareShapesRequest& request);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_LABELLED_MESH_H_
