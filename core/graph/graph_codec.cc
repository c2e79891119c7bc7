#include "core/graph/graph_codec.h"

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/sealed_bytes.h"
#include "core/base/status_macros.h"
#include "core/graph/node_codec.h"

namespace argmesh {
namespace {

constexpr std::string_view kGraphMagic = "ARGG";
constexpr size_t kModeBytes = 32;
// Threshold, count and three counts of nothing.
constexpr size_t kEmptyLevelBytes = 24;

void WriteMode(const ArgMode& mode, ByteWriter& writer) {
  writer.WriteF32Array(mode.position);
  writer.WriteF32(mode.window);
  writer.WriteU32(std::bit_cast<uint32_t>(mode.repeatability));
  writer.WriteF32(mode.density);
  writer.WriteF32(mode.offset);
  writer.WriteU32(std::bit_cast<uint32_t>(mode.node));
}

absl::StatusOr<ArgMode> ReadMode(ByteReader& reader) {
  ArgMode mode;
  for (float& x : mode.position) {
    ARGMESH_ASSIGN_OR_RETURN(x, reader.ReadF32());
  }
  ARGMESH_ASSIGN_OR_RETURN(mode.window, reader.ReadF32());
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t repeatability, reader.ReadU32());
  mode.repeatability = std::bit_cast<int32_t>(repeatability);
  ARGMESH_ASSIGN_OR_RETURN(mode.density, reader.ReadF32());
  ARGMESH_ASSIGN_OR_RETURN(mode.offset, reader.ReadF32());
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t node, reader.ReadU32());
  mode.node = std::bit_cast<int32_t>(node);
  return mode;
}

absl::Status ReadFrame(ByteReader& reader, ShapeGraph& graph) {
  for (double& x : graph.centroid) {
    ARGMESH_ASSIGN_OR_RETURN(x, reader.ReadF64());
  }
  ARGMESH_ASSIGN_OR_RETURN(graph.scale, reader.ReadF64());
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t components, reader.ReadU32());
  graph.num_components = std::bit_cast<int32_t>(components);
  ARGMESH_ASSIGN_OR_RETURN(graph.decomposition, reader.ReadU32());
  return absl::OkStatus();
}

}  // namespace

std::string SerializeShapeGraph(const ShapeGraph& graph) {
  ByteWriter writer;
  for (const double x : graph.centroid) writer.WriteF64(x);
  writer.WriteF64(graph.scale);
  writer.WriteU32(std::bit_cast<uint32_t>(graph.num_components));
  writer.WriteU32(graph.decomposition);
  writer.WriteU32(static_cast<uint32_t>(graph.levels.size()));
  for (const ArgLevel& level : graph.levels) WriteLevel(level, writer);
  WriteLevel(graph.uniform, writer);
  writer.WriteU32(static_cast<uint32_t>(graph.modes.size()));
  for (const ArgMode& mode : graph.modes) WriteMode(mode, writer);
  return SealBytes(kGraphMagic, kShapeGraphVersion, writer.bytes());
}

absl::StatusOr<ShapeGraph> ParseShapeGraph(std::string_view bytes) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::string_view payload,
      OpenSealedBytes("shape graph", kGraphMagic, kShapeGraphVersion, bytes));
  ByteReader reader(payload, "shape graph");
  ShapeGraph graph;
  ARGMESH_RETURN_IF_ERROR(ReadFrame(reader, graph));
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t levels,
                           reader.ReadCount(kEmptyLevelBytes));
  if (levels > static_cast<uint32_t>(kMaxGraphLevels)) {
    return absl::DataLossError(absl::StrFormat(
        "shape graph: %d levels, at most %d", levels, kMaxGraphLevels));
  }
  for (uint32_t l = 0; l < levels; ++l) {
    ARGMESH_ASSIGN_OR_RETURN(ArgLevel level, ReadLevel(reader));
    graph.levels.push_back(std::move(level));
  }
  ARGMESH_ASSIGN_OR_RETURN(graph.uniform, ReadLevel(reader));
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t modes, reader.ReadCount(kModeBytes));
  graph.modes.reserve(modes);
  for (uint32_t i = 0; i < modes; ++i) {
    ARGMESH_ASSIGN_OR_RETURN(const ArgMode mode, ReadMode(reader));
    graph.modes.push_back(mode);
  }
  ARGMESH_RETURN_IF_ERROR(reader.ExpectEnd());
  if (const absl::Status status = CheckShapeGraph(graph); !status.ok()) {
    return absl::DataLossError(std::string(status.message()));
  }
  return graph;
}

}  // namespace argmesh
