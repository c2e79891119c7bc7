#include "server/engine/ingest.h"

#include <optional>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "core/graph/graph_codec.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/error_reason.h"
#include "server/engine/mesh_upload.h"
#include "server/engine/query_resolver.h"
#include "server/engine/request_rules.h"
#include "server/engine/request_stamp.h"
#include "server/engine/surface_description.h"
#include "server/engine/uid.h"

namespace argmesh {
namespace {

// Everything the request asks for (StampRequest).
std::vector<std::string> RequestFields(const NewShape& shape,
                                       const Sha256Digest& sha256) {
  std::vector<std::string> fields = {
      shape.collection,
      shape.id,
      shape.display_name,
      shape.source_uri,
      std::string(MeshFormatName(shape.format)),
      ToHex(sha256),
      absl::StrFormat("%d", static_cast<int>(shape.if_exists)),
      shape.etag};
  AddFields(shape.metadata, fields);
  return fields;
}

ShapeRecord RecordOf(const NewShape& shape, const AnalyzedMesh& analyzed) {
  ShapeRecord record;
  record.collection = shape.collection;
  record.id = shape.id;
  record.uid = MakeUid();
  record.display_name = shape.display_name;
  record.source_uri = shape.source_uri;
  record.metadata = shape.metadata;
  record.format = analyzed.format;
  record.report = analyzed.computed.report;
  record.graph = SummarizeGraph(analyzed.computed.graph);
  record.create_time = absl::FromUnixMicros(absl::ToUnixMicros(absl::Now()));
  record.update_time = record.create_time;
  return record;
}

}  // namespace

struct Ingest::Source {
  std::string bytes;
  std::unique_ptr<StagedMesh> staged;  // null: `bytes` came with the call
  Sha256Digest sha256{};
};

struct Ingest::Searchable {
  MatchableGraph graph;
  PackedSignature signature;
  WindowWords words;
};

struct Ingest::Described {
  ShapePut put;
  Searchable searchable;
};

Ingest::Ingest(const EngineOptions& options, Catalog& catalog,
               MeshStore& meshes, Gallery& gallery,
               const RunningReindexes& running, MeshMemory& memory)
    : options_(options),
      analyzer_(options, memory, absl::InfiniteDuration()),
      catalog_(catalog),
      meshes_(meshes),
      gallery_(gallery),
      running_(running) {}

MeshStore::IsReferenced Ingest::is_referenced() const {
  return [&catalog = catalog_](const Sha256Digest& sha256) {
    return catalog.IsMeshReferenced(sha256);
  };
}

void Ingest::RemoveMeshes(const std::vector<Sha256Digest>& unreferenced) {
  for (const Sha256Digest& sha256 : unreferenced) {
    (void)meshes_.RemoveUnreferenced(sha256, is_referenced());
  }
}

absl::StatusOr<Ingest::Source> Ingest::Open(const NewShape& shape,
                                            MeshSource mesh) const {
  Source source;
  if (auto* staged = std::get_if<std::unique_ptr<StagedMesh>>(&mesh)) {
    source.staged = std::move(*staged);
    ARGMESH_RETURN_IF_ERROR(
        CheckMeshSize(source.staged->size_bytes(), options_.mesh_limits));
    source.sha256 = source.staged->sha256();
  } else {
    source.bytes = std::get<std::string>(std::move(mesh));
    ARGMESH_RETURN_IF_ERROR(CheckMeshSize(
        static_cast<int64_t>(source.bytes.size()), options_.mesh_limits));
    source.sha256 = ComputeSha256(source.bytes);
  }
  if (shape.sha256) {
    ARGMESH_RETURN_IF_ERROR(CheckDigest(*shape.sha256, source.sha256));
  }
  return source;
}

// What can be answered without computing anything; the catalog decides again
// when the row is written.
absl::StatusOr<std::optional<AddedShape>> Ingest::FindStored(
    const NewShape& shape, const Sha256Digest& sha256,
    const RequestStamp& request) const {
  ARGMESH_ASSIGN_OR_RETURN(std::optional<ShapeWritten> answered,
                           catalog_.FindPutShape(request));
  if (answered) {
    gallery_.Follow(shape.collection, answered->collection_uid,
                    answered->record.generation, std::nullopt);
    return AddedShape{std::move(answered->record), true};
  }
  if (shape.if_exists == IfExists::kReplace) return std::nullopt;
  absl::StatusOr<ShapeRecord> stored =
      catalog_.GetShape(shape.collection, shape.id);
  if (absl::IsNotFound(stored.status())) return std::nullopt;
  ARGMESH_RETURN_IF_ERROR(stored.status());
  if (shape.if_exists == IfExists::kReturnSame && stored->sha256 == sha256) {
    return AddedShape{*std::move(stored), true};
  }
  return ShapeExistsError(shape.collection, shape.id);
}

absl::StatusOr<MeshPin> Ingest::PublishMesh(Source& source) {
  if (source.staged == nullptr) {
    ARGMESH_ASSIGN_OR_RETURN(
        const std::unique_ptr<MeshWriter> writer,
        meshes_.StartWrite(static_cast<int64_t>(source.bytes.size())));
    ARGMESH_RETURN_IF_ERROR(writer->Append(source.bytes));
    ARGMESH_ASSIGN_OR_RETURN(source.staged, writer->Seal());
  }
  return source.staged->Publish();
}

absl::StatusOr<AddedShape> Ingest::Commit(const ShapePut& put,
                                          Searchable searchable) {
  ARGMESH_ASSIGN_OR_RETURN(ShapeWritten written, catalog_.PutShape(put));
  std::optional<IndexedShape> shape;
  if (written.written) {
    shape.emplace();
    shape->entry = std::make_shared<const GalleryEntry>(
        GalleryEntry{written.record, std::move(searchable.graph),
                     std::move(searchable.signature)});
    shape->words = std::move(searchable.words);
  }
  gallery_.Follow(put.record.collection, written.collection_uid,
                  written.record.generation, std::move(shape));
  RemoveMeshes(written.unreferenced);
  return AddedShape{std::move(written.record), !written.written};
}

// With the settings that the collection has when it is written: what a switch
// overtook is described again.
absl::StatusOr<AddedShape> Ingest::CommitAsIs(const NewShape& shape,
                                              const Source& source,
                                              Described described,
                                              const StopToken& stop) {
  while (true) {
    absl::StatusOr<AddedShape> added =
        Commit(described.put, std::move(described.searchable));
    if (ReasonOf(added.status()) != ErrorReason::kGraphVersionMismatch) {
      return added;
    }
    ARGMESH_ASSIGN_OR_RETURN(const CollectionRecord collection,
                             catalog_.GetCollection(shape.collection));
    RequestStamp request = std::move(described.put.request);
    ARGMESH_ASSIGN_OR_RETURN(described,
                             Describe(shape, collection, source, stop));
    described.put.request = std::move(request);
  }
}

absl::StatusOr<AddedShape> Ingest::Store(const NewShape& shape, Source& source,
                                         Described described,
                                         const StopToken& stop) {
  if (!described.put.record.mesh_stored) {
    return CommitAsIs(shape, source, std::move(described), stop);
  }
  absl::StatusOr<AddedShape> added;
  {
    ARGMESH_ASSIGN_OR_RETURN(const MeshPin pin, PublishMesh(source));
    added = CommitAsIs(shape, source, std::move(described), stop);
  }
  if (!added.ok() || added->already_stored) {
    RemoveMeshes({source.sha256});  // unless another shape has it
  }
  return added;
}

absl::StatusOr<StagedDescription> Ingest::DescribeWith(
    const CollectionSettings& settings, const std::string& bytes,
    MeshFormat format, const StopToken& stop) const {
  ARGMESH_ASSIGN_OR_RETURN(const AnalyzedMesh analyzed,
                           analyzer_.Analyze(bytes, format, settings, stop));
  StagedDescription description;
  description.stage = {settings, kShapeGraphVersion};
  description.report = analyzed.computed.report;
  description.summary = SummarizeGraph(analyzed.computed.graph);
  description.graph = SerializeShapeGraph(analyzed.computed.graph);
  description.labels = SerializeFaceLabels(analyzed.computed.labels);
  return description;
}

absl::StatusOr<Ingest::Described> Ingest::Describe(
    const NewShape& shape, const CollectionRecord& collection,
    const Source& source, const StopToken& stop) const {
  ARGMESH_ASSIGN_OR_RETURN(
      AnalyzedMesh analyzed,
      analyzer_.Analyze(source.bytes, shape.format, collection.settings, stop));
  ShapePut put;
  put.record = RecordOf(shape, analyzed);
  put.record.sha256 = source.sha256;
  put.record.size_bytes = static_cast<int64_t>(source.bytes.size());
  put.record.mesh_stored = collection.settings.store_meshes;
  put.collection_uid = collection.uid;
  put.settings = collection.settings;
  put.graph_version = kShapeGraphVersion;
  put.graph = SerializeShapeGraph(analyzed.computed.graph);
  put.labels = SerializeFaceLabels(analyzed.computed.labels);
  absl::StatusOr<SurfaceDescription> surface =
      DescribeSurface(analyzed.computed.repaired, analyzed.within);
  if (!surface.ok()) return OverComputeTime(surface.status(), stop, options_);
  put.descriptors = std::move(surface->bytes);
  put.if_exists = shape.if_exists;
  put.etag = shape.etag;
  const auto goal = running_.Goal(collection.uid);
  if (goal && !MakeSameGraphs(*goal, collection.settings)) {
    // It needs the memory of this one, which is done with its surface.
    analyzed.memory = {};
    // One that fails is left to the reindex, which tells why.
    absl::StatusOr<StagedDescription> staged =
        DescribeWith(*goal, source.bytes, shape.format, analyzed.within);
    if (staged.ok()) put.staged = *std::move(staged);
  }
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  return Described{
      std::move(put),
      {MatchableGraph(analyzed.computed.graph),
       PackedSignature(surface->signature), std::move(surface->words)}};
}

absl::Status Ingest::DescribeAnew(const CollectionRecord& collection,
                                  const ShapeRecord& stored,
                                  const StopToken& stop) {
  Source source;
  source.sha256 = stored.sha256;
  ARGMESH_ASSIGN_OR_RETURN(source.bytes, ReadMeshFile(meshes_, stored));
  NewShape shape;
  shape.collection = stored.collection;
  shape.id = stored.id;
  shape.display_name = stored.display_name;
  shape.source_uri = stored.source_uri;
  shape.metadata = stored.metadata;
  shape.format = stored.format;
  shape.if_exists = IfExists::kReplace;
  shape.etag = ShapeEtag(stored);
  ARGMESH_ASSIGN_OR_RETURN(Described described,
                           Describe(shape, collection, source, stop));
  // The mesh is there and stays: the row that names it is replaced by one that
  // does, or not at all.
  return Commit(described.put, std::move(described.searchable)).status();
}

absl::Status Ingest::PutAside(const CollectionRecord& collection,
                              const ShapeRecord& stored,
                              const CollectionSettings& settings,
                              const StopToken& stop) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string bytes,
                           ReadMeshFile(meshes_, stored));
  ShapeStaging staging;
  staging.collection = collection.id;
  staging.collection_uid = collection.uid;
  staging.id = stored.id;
  staging.sha256 = stored.sha256;
  ARGMESH_ASSIGN_OR_RETURN(staging.description,
                           DescribeWith(settings, bytes, stored.format, stop));
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  return catalog_.StageShape(staging);
}

absl::StatusOr<AddedShape> Ingest::AddShape(const NewShape& shape,
                                            MeshSource mesh,
                                            const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(CheckNewShape(shape));
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRecord collection,
                           catalog_.GetCollection(shape.collection));
  ARGMESH_ASSIGN_OR_RETURN(Source source, Open(shape, std::move(mesh)));
  ARGMESH_ASSIGN_OR_RETURN(RequestStamp request,
                           StampRequest(shape.request, "AddShape",
                                        RequestFields(shape, source.sha256),
                                        absl::Now() + options_.request_memory));
  ARGMESH_ASSIGN_OR_RETURN(std::optional<AddedShape> stored,
                           FindStored(shape, source.sha256, request));
  if (stored) return *std::move(stored);
  ARGMESH_RETURN_IF_ERROR(
      CheckDeclaredValues(collection.metadata_keys, shape.metadata));
  if (collection.graph_version != kShapeGraphVersion) {
    return MakeError(
        ErrorReason::kGraphVersionMismatch,
        absl::StrFormat("the collection's graphs have version %d, "
                        "this server computes %d",
                        collection.graph_version, kShapeGraphVersion));
  }
  if (source.staged != nullptr) {
    ARGMESH_ASSIGN_OR_RETURN(source.bytes, source.staged->ReadAll());
  }
  ARGMESH_ASSIGN_OR_RETURN(Described described,
                           Describe(shape, collection, source, stop));
  described.put.request = std::move(request);
  return Store(shape, source, std::move(described), stop);
}

}  // namespace argmesh
