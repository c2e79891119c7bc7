// The stored bytes of a ShapeGraph and of FaceLabels (docs/formats.md).
//
// Versioned, checksummed with CRC-32C, bounds-checked: hostile bytes give
// kDataLoss and never cost more memory than a small multiple of themselves;
// another version gives kFailedPrecondition.
// Serialize then Parse gives the same graph to the bit. Cost O(bytes).
#ifndef ARGMESH_CORE_GRAPH_GRAPH_CODEC_H_
#define ARGMESH_CORE_GRAPH_GRAPH_CODEC_H_

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/graph/shape_graph.h"

namespace argmesh {

std::string SerializeShapeGraph(const ShapeGraph& graph);
absl::StatusOr<ShapeGraph> ParseShapeGraph(std::string_view bytes);

std::string SerializeFaceLabels(const FaceLabels& labels);
absl::StatusOr<FaceLabels> ParseFaceLabels(std::string_view bytes);

}  // namespace argmesh

#endif  // ARGMESH_CORE_GRAPH_GRAPH_CODEC_H_
