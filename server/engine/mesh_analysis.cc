#include "server/engine/mesh_analysis.h"

#include <algorithm>
#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

// The number after `word` in a parser's message, "line 12: ..." is 12.
std::string NumberAfter(const std::string& message, const std::string& word) {
  const size_t found = message.find(word + " ");
  if (found == std::string::npos) return "";
  const size_t begin = found + word.size() + 1;
  const size_t end = message.find_first_not_of("0123456789", begin);
  return message.substr(begin, std::min(end, message.size()) - begin);
}

absl::Status ParseError(const absl::Status& status, MeshFormat format) {
  const std::string message(status.message());
  if (absl::IsResourceExhausted(status)) {
    return MakeError(ErrorReason::kMeshTooLarge, message);
  }
  if (!absl::IsInvalidArgument(status)) return status;
  if (format == MeshFormat::kUnknown &&
      message.find("begins no") != std::string::npos) {
    return MakeError(ErrorReason::kMeshFormatUnknown, message);
  }
  if (message.find("no faces: ") != std::string::npos) {
    return MakeError(ErrorReason::kMeshEmpty, message);
  }
  ErrorMetadata where;
  if (const std::string line = NumberAfter(message, "line"); !line.empty()) {
    where["line"] = line;
  } else if (std::string at = NumberAfter(message, "byte"); !at.empty()) {
    where["offset"] = at;
  }
  return MakeError(ErrorReason::kMeshMalformed, message, where);
}

absl::Status ComputeError(const absl::Status& status) {
  const std::string message(status.message());
  if (absl::IsFailedPrecondition(status)) {
    return MakeError(ErrorReason::kMeshDegenerate, message);
  }
  if (absl::IsResourceExhausted(status)) {
    return MakeError(ErrorReason::kMeshTooLarge, message);
  }
  return status;
}

AbstractionOptions AbstractionOptionsOf(const CollectionSettings& settings) {
  AbstractionOptions options;
  options.resample.vertex_budget = settings.vertex_budget;
  options.decomposition.kind = settings.decomposition;
  options.uniform_cells = settings.uniform_cells;
  return options;
}

GraphSummary::Level SummarizeLevel(std::string name, const ArgLevel& level) {
  return {std::move(name), level.num_nodes(),
          static_cast<int32_t>(level.edges.size())};
}

}  // namespace

absl::Status OverComputeTime(const absl::Status& status, const StopToken& stop,
                             const EngineOptions& options) {
  if (!absl::IsDeadlineExceeded(status) || !stop.Check().ok()) return status;
  const std::string limit = absl::FormatDuration(options.max_compute_time);
  return MakeError(ErrorReason::kMeshTooLarge,
                   absl::StrFormat("the mesh takes longer than %s", limit),
                   {{"limit", limit}});
}

absl::Status CheckMeshSize(int64_t bytes, const MeshLimits& limits) {
  if (bytes <= 0) {
    return MakeError(ErrorReason::kMeshEmpty, "the mesh has no bytes");
  }
  if (bytes <= limits.max_bytes) return absl::OkStatus();
  return MakeError(ErrorReason::kMeshTooLarge,
                   absl::StrFormat("the mesh has %d bytes, more than %d", bytes,
                                   limits.max_bytes),
                   {{"size", absl::StrFormat("%d", bytes)},
                    {"limit", absl::StrFormat("%d", limits.max_bytes)}});
}

absl::StatusOr<AnalyzedMesh> MeshAnalyzer::AnalyzeParsed(
    TriangleMesh mesh, const CollectionSettings& settings,
    const StopToken& stop) const {
  if (mesh.num_vertices() == 0 || mesh.num_faces() == 0) {
    return MakeError(ErrorReason::kMeshEmpty,
                     absl::StrFormat("the mesh has %d vertices and %d faces",
                                     mesh.num_vertices(), mesh.num_faces()));
  }
  AnalyzedMesh analyzed;
  ARGMESH_ASSIGN_OR_RETURN(
      analyzed.memory,
      memory_.Claim(mesh.num_vertices(), mesh.num_faces(), max_wait_, stop));
  analyzed.within = stop.WithDeadline(absl::Now() + options_.max_compute_time);
  absl::StatusOr<ComputedGraph> computed =
      ComputeShapeGraph(mesh, AbstractionOptionsOf(settings), analyzed.within);
  if (!computed.ok()) {
    return OverComputeTime(ComputeError(computed.status()), stop, options_);
  }
  analyzed.computed = *std::move(computed);
  analyzed.mesh = std::move(mesh);
  return analyzed;
}

absl::StatusOr<AnalyzedMesh> MeshAnalyzer::Analyze(
    std::string_view bytes, MeshFormat format,
    const CollectionSettings& settings, const StopToken& stop) const {
  ARGMESH_RETURN_IF_ERROR(
      CheckMeshSize(static_cast<int64_t>(bytes.size()), options_.mesh_limits));
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  absl::StatusOr<ParsedMesh> parsed =
      ParseMesh(bytes, format, options_.mesh_limits);
  if (!parsed.ok()) return ParseError(parsed.status(), format);
  ARGMESH_ASSIGN_OR_RETURN(
      AnalyzedMesh analyzed,
      AnalyzeParsed(std::move(parsed->mesh), settings, stop));
  analyzed.format = parsed->format;
  return analyzed;
}

GraphSummary SummarizeGraph(const ShapeGraph& graph) {
  GraphSummary summary;
  summary.version = kShapeGraphVersion;
  summary.modes = static_cast<int32_t>(graph.modes.size());
  const std::vector<std::string> names = LevelNames(graph);
  for (size_t l = 0; l < graph.levels.size(); ++l) {
    summary.levels.push_back(SummarizeLevel(names[l], graph.levels[l]));
  }
  if (names.size() > graph.levels.size()) {
    summary.levels.push_back(SummarizeLevel(names.back(), graph.uniform));
  }
  return summary;
}

}  // namespace argmesh
