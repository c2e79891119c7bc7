#include "server/engine/query_resolver.h"

#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/containment/query_windows.h"
#include "core/graph/graph_codec.h"
#include "core/mesh/mesh_repair.h"
#include "core/signature/signature_codec.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/error_reason.h"
#include "server/engine/mesh_analysis.h"
#include "server/engine/request_rules.h"

namespace argmesh {
namespace {

constexpr int64_t kReadBytes = 1 << 20;

ErrorMetadata Which(const ShapeRecord& record) {
  return {{"collection", record.collection}, {"shape", record.id}};
}

absl::Status DamagedError(const ShapeRecord& record,
                          const absl::Status& status) {
  return MakeError(
      ErrorReason::kStoredDataDamaged,
      absl::StrFormat("shape %s: %s", record.id, std::string(status.message())),
      Which(record));
}

absl::Status VersionError(const ShapeRecord& record, std::string_view what) {
  return MakeError(ErrorReason::kGraphVersionMismatch,
                   absl::StrFormat("the %s of shape %s is of another version",
                                   what, record.id),
                   Which(record));
}

absl::StatusOr<ShapeSignature> ParseStoredSignature(const StoredGraph& stored) {
  if (stored.signature.empty()) return VersionError(stored.record, "signature");
  absl::StatusOr<ShapeSignature> signature = DecodeSignature(stored.signature);
  if (signature.ok()) return signature;
  return absl::IsFailedPrecondition(signature.status())
             ? VersionError(stored.record, "signature")
             : DamagedError(stored.record, signature.status());
}

absl::Status FillSurface(const TriangleMesh& repaired, const QueryNeeds& needs,
                         const StopToken& stop, ResolvedQuery& query) {
  if (needs.signature) {
    ARGMESH_ASSIGN_OR_RETURN(query.signature,
                             ComputeShapeSignature(repaired, {}, stop));
  }
  if (needs.windows) {
    ARGMESH_ASSIGN_OR_RETURN(query.windows,
                             ExtractQueryWindows(repaired, {}, stop));
  }
  return absl::OkStatus();
}

absl::StatusOr<ResolvedQuery> ResolveAnalyzed(AnalyzedMesh analyzed,
                                              const QueryNeeds& needs,
                                              const EngineOptions& options,
                                              const StopToken& stop) {
  ComputedGraph& computed = analyzed.computed;
  ResolvedQuery query;
  if (const absl::Status status =
          FillSurface(computed.repaired, needs, analyzed.within, query);
      !status.ok()) {
    return OverComputeTime(status, stop, options);
  }
  if (needs.surface) {
    query.surface = {std::move(analyzed.mesh), computed.labels};
  }
  query.graph = {std::move(computed.graph), std::move(computed.labels),
                 computed.report};
  return query;
}

// Keeps the faces whose finest component is one of `nodes`.
absl::Status KeepRegion(const ShapeRef& shape, const FaceLabels& labels,
                        std::span<const int32_t> nodes, int num_nodes,
                        TriangleMesh& mesh) {
  std::vector<bool> kept(static_cast<size_t>(num_nodes));
  for (const int32_t node : nodes) {
    if (node < 0 || node >= num_nodes) {
      return MakeError(
          ErrorReason::kNodeNotFound,
          absl::StrFormat("shape %s has no node %d: its finest level has %d",
                          shape.id, node, num_nodes),
          {{"collection", shape.collection}, {"shape", shape.id}});
    }
    kept[static_cast<size_t>(node)] = true;
  }
  int faces = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const int16_t label = labels.component[static_cast<size_t>(f)];
    if (label >= 0 && kept[static_cast<size_t>(label)]) {
      mesh.F.row(faces++) = mesh.F.row(f);
    }
  }
  mesh.F.conservativeResize(faces, Eigen::NoChange);
  RemoveUnusedVertices(mesh);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<ShapeGraph> ParseStoredGraph(const StoredGraph& stored) {
  if (stored.graph_version != kShapeGraphVersion) {
    return MakeError(
        ErrorReason::kGraphVersionMismatch,
        absl::StrFormat("the graph of shape %s has version %d, not %d",
                        stored.record.id, stored.graph_version,
                        kShapeGraphVersion),
        Which(stored.record));
  }
  absl::StatusOr<ShapeGraph> graph = ParseShapeGraph(stored.graph);
  if (graph.ok()) return graph;
  return DamagedError(stored.record, graph.status());
}

absl::Status MeshNotStoredError(const ShapeRecord& record) {
  return MakeError(
      ErrorReason::kMeshNotStored,
      absl::StrFormat("collection %s keeps no meshes", record.collection),
      Which(record));
}

absl::StatusOr<std::string> ReadMeshFile(const MeshStore& meshes,
                                         const ShapeRecord& record) {
  if (!record.mesh_stored) return MeshNotStoredError(record);
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<MeshReader> reader,
                           meshes.Open(record.sha256));
  std::string bytes;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const std::string piece, reader->Read(kReadBytes));
    if (piece.empty()) return bytes;
    bytes += piece;
  }
}

absl::StatusOr<TriangleMesh> QueryResolver::ReadMesh(
    const ShapeRecord& record) const {
  ARGMESH_ASSIGN_OR_RETURN(const std::string bytes,
                           ReadMeshFile(meshes_, record));
  absl::StatusOr<ParsedMesh> parsed =
      ParseMesh(bytes, record.format, options_.mesh_limits);
  if (!parsed.ok()) return DamagedError(record, parsed.status());
  return std::move(parsed->mesh);
}

absl::StatusOr<StoredGraph> QueryResolver::ReadGraph(
    const ShapeRef& shape, const CollectionSettings& settings,
    bool with_labels) const {
  ARGMESH_RETURN_IF_ERROR(CheckShapeRef(shape));
  ARGMESH_ASSIGN_OR_RETURN(
      StoredGraph stored,
      catalog_.ReadGraph(shape.collection, shape.id, with_labels));
  if (!MakeSameGraphs(stored.settings, settings)) {
    return OtherSettingsError(shape.collection);
  }
  return stored;
}

absl::StatusOr<LabelledSurface> QueryResolver::ReadLabelledSurface(
    const StoredGraph& stored) const {
  absl::StatusOr<FaceLabels> labels = ParseFaceLabels(stored.labels);
  if (!labels.ok()) return DamagedError(stored.record, labels.status());
  ARGMESH_ASSIGN_OR_RETURN(TriangleMesh mesh, ReadMesh(stored.record));
  if (labels->component.size() != static_cast<size_t>(mesh.num_faces())) {
    return DamagedError(stored.record,
                        absl::DataLossError("its labels are of another mesh"));
  }
  return LabelledSurface{std::move(mesh), *std::move(labels)};
}

absl::StatusOr<StoredSurface> QueryResolver::ReadSurface(
    const ShapeRef& shape, const CollectionSettings& settings) const {
  ARGMESH_ASSIGN_OR_RETURN(const StoredGraph stored,
                           ReadGraph(shape, settings, true));
  StoredSurface surface;
  surface.sha256 = stored.record.sha256;
  ARGMESH_ASSIGN_OR_RETURN(surface.graph, ParseStoredGraph(stored));
  ARGMESH_ASSIGN_OR_RETURN(surface.surface, ReadLabelledSurface(stored));
  return surface;
}

absl::StatusOr<ResolvedQuery> QueryResolver::ResolveStored(
    const ShapeRef& shape, const CollectionSettings& settings,
    const QueryNeeds& needs, const StopToken& stop) const {
  ARGMESH_ASSIGN_OR_RETURN(const StoredGraph stored,
                           ReadGraph(shape, settings, needs.surface));
  ResolvedQuery query;
  query.graph.report = stored.record.report;
  query.sha256 = stored.record.sha256;
  ARGMESH_ASSIGN_OR_RETURN(query.graph.graph, ParseStoredGraph(stored));
  if (needs.signature) {
    ARGMESH_ASSIGN_OR_RETURN(query.signature, ParseStoredSignature(stored));
  }
  if (needs.surface) {
    ARGMESH_ASSIGN_OR_RETURN(query.surface, ReadLabelledSurface(stored));
  }
  if (needs.windows) {
    ARGMESH_ASSIGN_OR_RETURN(const RepairedMesh repaired,
                             RepairMesh(query.surface->mesh));
    ARGMESH_RETURN_IF_ERROR(
        FillSurface(repaired.mesh, {.windows = true}, stop, query));
  }
  return query;
}

absl::StatusOr<ResolvedQuery> QueryResolver::Resolve(
    const QueryShape& shape, const CollectionSettings& settings,
    const QueryNeeds& needs, const StopToken& stop) const {
  if (const auto* stored = std::get_if<ShapeRef>(&shape)) {
    return ResolveStored(*stored, settings, needs, stop);
  }
  if (const auto* mesh = std::get_if<MeshBytes>(&shape)) {
    ARGMESH_ASSIGN_OR_RETURN(
        AnalyzedMesh analyzed,
        analyzer_.Analyze(mesh->bytes, mesh->format, settings, stop));
    ARGMESH_ASSIGN_OR_RETURN(
        ResolvedQuery query,
        ResolveAnalyzed(std::move(analyzed), needs, options_, stop));
    query.sha256 = ComputeSha256(mesh->bytes);
    return query;
  }
  const auto& graph = std::get<ShapeGraph>(shape);
  if (const absl::Status status = CheckShapeGraph(graph); !status.ok()) {
    return MakeError(ErrorReason::kGraphInvalid, std::string(status.message()));
  }
  ResolvedQuery query;
  query.graph.graph = graph;
  return query;
}

absl::StatusOr<ResolvedQuery> QueryResolver::ResolveRegion(
    const ShapeRef& shape, std::span<const int32_t> nodes,
    const CollectionSettings& settings, const QueryNeeds& needs,
    const StopToken& stop) const {
  ARGMESH_ASSIGN_OR_RETURN(StoredSurface stored, ReadSurface(shape, settings));
  const ShapeGraph& graph = stored.graph;
  auto& [mesh, labels] = stored.surface;
  const int num_nodes =
      graph.levels.empty() ? 0 : graph.levels.back().num_nodes();
  ARGMESH_RETURN_IF_ERROR(KeepRegion(shape, labels, nodes, num_nodes, mesh));
  ARGMESH_ASSIGN_OR_RETURN(
      AnalyzedMesh analyzed,
      analyzer_.AnalyzeParsed(std::move(mesh), settings, stop));
  return ResolveAnalyzed(std::move(analyzed), needs, options_, stop);
}

}  // namespace argmesh
