// argmesh/v1/graph.proto to and from core/graph.
#ifndef ARGMESH_SERVER_RPC_CONVERT_GRAPH_H_
#define ARGMESH_SERVER_RPC_CONVERT_GRAPH_H_

#include <cstdint>
#include <string_view>

#include "absl/status/statusor.h"
#include "argmesh/v1/graph.pb.h"
#include "core/graph/shape_graph.h"

namespace argmesh {

v1::ShapeGraph ToProto(const ShapeGraph& graph);

// The exact mirror of ToProto. GRAPH_INVALID with metadata `field` for a graph
// that is not well formed, GRAPH_VERSION_MISMATCH for another version.
absl::StatusOr<ShapeGraph> FromProto(std::string_view field,
                                     const v1::ShapeGraph& graph);

// Labels of the triangles first_face .. first_face + count - 1 at a level;
// `level` is levels.size() for the uniform cells. What is beyond the last
// triangle is left out.
struct FaceRange {
  int64_t first_face = 0;
  int64_t count = 0;
};
v1::FaceLabels ToProto(const ShapeGraph& graph, const FaceLabels& labels,
                       int level, const FaceRange& range);

// 0 .. levels.size() - 1, and levels.size() when there are uniform cells.
int NumLabelLevels(const ShapeGraph& graph, const FaceLabels& labels);

// At most so many bytes does one label take in a message.
inline constexpr int64_t kMaxLabelBytes = 3;

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_GRAPH_H_
