#include "core/graph/node_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

// Calls visit(span of floats) on every group of floats of a node, in stored
// order: the one list that writing and reading share.
template <typename Node, typename Visit>
void VisitFloats(Node& node, const Visit& visit) {
  auto& t = node.tuple;
  for (auto* value : {&t.normal_deviation, &t.gauss_deviation, &t.gauss_mean,
                      &t.mean_deviation, &t.mean_mean, &t.geodesic_deviation,
                      &t.geodesic_mean, &t.log2_relative_area}) {
    visit(std::span(value, 1));
  }
  auto& h = node.histograms;
  visit(std::span(h.shape_diameter));
  visit(std::span(h.average_geodesic));
  visit(std::span(h.shape_index));
  visit(std::span(h.curvedness));
  visit(std::span(h.internal_distance));
  visit(std::span(h.outer_distance));
  visit(std::span(h.relative_diameter));
  visit(std::span(node.wave_kernel));
  visit(std::span(&node.area, 1));
  visit(std::span(node.center));
}

constexpr size_t kNodeFloats = 8 + 67 + 16 + 1 + 3;
constexpr size_t kNodeBytes = 4 * kNodeFloats + 4;
constexpr size_t kEdgeBytes = 16;

void WriteNode(const ArgNode& node, ByteWriter& writer) {
  VisitFloats(node, [&writer](std::span<const float> values) {
    writer.WriteF32Array(values);
  });
  writer.WriteU32(std::bit_cast<uint32_t>(node.parent));
}

absl::StatusOr<ArgNode> ReadNode(ByteReader& reader) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string_view bytes,
                           reader.ReadBytes(kNodeBytes));
  ArgNode node;
  size_t at = 0;
  VisitFloats(node, [&bytes, &at](std::span<float> values) {
    std::memcpy(values.data(), bytes.data() + at, values.size_bytes());
    at += values.size_bytes();
  });
  std::memcpy(&node.parent, bytes.data() + at, sizeof(node.parent));
  return node;
}

absl::StatusOr<ArgEdge> ReadEdge(ByteReader& reader) {
  ArgEdge edge;
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t a, reader.ReadU32());
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t b, reader.ReadU32());
  edge.a = std::bit_cast<int32_t>(a);
  edge.b = std::bit_cast<int32_t>(b);
  ARGMESH_ASSIGN_OR_RETURN(edge.geodesic, reader.ReadF32());
  ARGMESH_ASSIGN_OR_RETURN(edge.border_length, reader.ReadF32());
  return edge;
}

}  // namespace

void WriteLevel(const ArgLevel& level, ByteWriter& writer) {
  writer.WriteF64(level.threshold);
  writer.WriteU32(std::bit_cast<uint32_t>(level.count));
  writer.WriteU32(static_cast<uint32_t>(level.nodes.size()));
  for (const ArgNode& node : level.nodes) WriteNode(node, writer);
  writer.WriteU32(static_cast<uint32_t>(level.edges.size()));
  for (const ArgEdge& edge : level.edges) {
    writer.WriteU32(std::bit_cast<uint32_t>(edge.a));
    writer.WriteU32(std::bit_cast<uint32_t>(edge.b));
    writer.WriteF32(edge.geodesic);
    writer.WriteF32(edge.border_length);
  }
  writer.WriteU32(static_cast<uint32_t>(level.distances.size()));
  writer.WriteF32Array(level.distances);
}

absl::StatusOr<ArgLevel> ReadLevel(ByteReader& reader) {
  ArgLevel level;
  ARGMESH_ASSIGN_OR_RETURN(level.threshold, reader.ReadF64());
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t count, reader.ReadU32());
  level.count = std::bit_cast<int32_t>(count);
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t nodes, reader.ReadCount(kNodeBytes));
  if (nodes > static_cast<uint32_t>(kMaxGraphNodes)) {
    return absl::DataLossError(absl::StrFormat(
        "shape graph: %d nodes in a level, at most %d", nodes, kMaxGraphNodes));
  }
  level.nodes.reserve(nodes);
  for (uint32_t i = 0; i < nodes; ++i) {
    ARGMESH_ASSIGN_OR_RETURN(ArgNode node, ReadNode(reader));
    level.nodes.push_back(node);
  }
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t edges, reader.ReadCount(kEdgeBytes));
  level.edges.reserve(edges);
  for (uint32_t i = 0; i < edges; ++i) {
    ARGMESH_ASSIGN_OR_RETURN(const ArgEdge edge, ReadEdge(reader));
    level.edges.push_back(edge);
  }
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t pairs, reader.ReadCount(4));
  ARGMESH_ASSIGN_OR_RETURN(level.distances, reader.ReadF32Array(pairs));
  return level;
}

}  // namespace argmesh
