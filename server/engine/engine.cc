#include "server/engine/engine.h"

#include <mutex>
#include <utility>

#include "core/base/status_macros.h"
#include "core/graph/graph_codec.h"
#include "server/engine/engine_parts.h"
#include "server/engine/error_reason.h"
#include "server/engine/request_rules.h"

namespace argmesh {
namespace {

absl::Status CheckOptions(const EngineOptions& options) {
  if (options.max_compute_time <= absl::ZeroDuration() ||
      options.request_memory <= absl::ZeroDuration() ||
      options.sweep_age < absl::ZeroDuration() ||
      options.mesh_limits.max_bytes <= 0) {
    return absl::InvalidArgumentError("an engine option is out of its range");
  }
  return absl::OkStatus();
}

}  // namespace

Engine::Parts::Parts(const EngineOptions& engine_options,
                     std::unique_ptr<Catalog> engine_catalog,
                     std::unique_ptr<MeshStore> engine_meshes)
    : options(engine_options),
      catalog(std::move(engine_catalog)),
      meshes(std::move(engine_meshes)),
      pool(options.pool),
      mesh_memory(options.mesh_memory),
      gallery(*catalog, pool),
      ingest(options, *catalog, *meshes, gallery, running_reindexes,
             mesh_memory),
      reindexer(*catalog, gallery, ingest, pool, running_reindexes),
      search(options, *catalog, *meshes, gallery, mesh_memory, pool),
      housekeeping(*catalog, *meshes, gallery, ingest, options.sweep_age) {}

absl::Status Engine::Parts::CheckOpen() const {
  if (!closed) return absl::OkStatus();
  return WithRetryDelay(
      MakeError(ErrorReason::kDraining, "the engine is closed"),
      absl::Seconds(1));
}

absl::StatusOr<std::unique_ptr<Engine>> Engine::Create(
    const EngineOptions& options, std::unique_ptr<Catalog> catalog,
    std::unique_ptr<MeshStore> meshes) {
  ARGMESH_RETURN_IF_ERROR(CheckOptions(options));
  auto parts =
      std::make_unique<Parts>(options, std::move(catalog), std::move(meshes));
  parts->housekeeping.Start();
  return std::unique_ptr<Engine>(new Engine(std::move(parts)));
}

Engine::Engine(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Engine::~Engine() { (void)Close(); }

absl::Status Engine::Close() {
  const std::lock_guard lock(parts_->close_mutex);
  if (parts_->closed.exchange(true)) return absl::OkStatus();
  parts_->gallery.Close();
  parts_->pool.Close();
  parts_->housekeeping.Stop();
  return parts_->catalog->Close();
}

ComputePool& Engine::pool() { return parts_->pool; }
const EngineOptions& Engine::options() const { return parts_->options; }

absl::StatusOr<std::unique_ptr<MeshUpload>> Engine::StartUpload(
    const UploadAnnouncement& announced) {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(
      CheckMeshSize(announced.size_bytes, parts_->options.mesh_limits));
  ARGMESH_ASSIGN_OR_RETURN(std::unique_ptr<MeshWriter> writer,
                           parts_->meshes->StartWrite(announced.size_bytes));
  return std::make_unique<MeshUpload>(announced, std::move(writer));
}

absl::StatusOr<AddedShape> Engine::AddShape(const NewShape& shape,
                                            MeshSource mesh,
                                            const StopToken& stop) {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  return parts_->ingest.AddShape(shape, std::move(mesh), stop);
}

absl::StatusOr<std::unique_ptr<MeshReader>> Engine::OpenMesh(
    const ShapeRef& shape) const {
  ARGMESH_ASSIGN_OR_RETURN(const ShapeRecord record, GetShape(shape));
  if (record.mesh_stored) return parts_->meshes->Open(record.sha256);
  return MeshNotStoredError(record);
}

absl::StatusOr<ShapeGraphAnswer> Engine::GetGraph(const ShapeRef& shape,
                                                  bool with_labels) const {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckShapeRef(shape));
  ARGMESH_ASSIGN_OR_RETURN(
      StoredGraph stored,
      parts_->catalog->ReadGraph(shape.collection, shape.id, with_labels));
  ShapeGraphAnswer answer;
  ARGMESH_ASSIGN_OR_RETURN(answer.graph, ParseStoredGraph(stored));
  if (with_labels) {
    absl::StatusOr<FaceLabels> labels = ParseFaceLabels(stored.labels);
    if (!labels.ok()) {
      return MakeError(ErrorReason::kStoredDataDamaged,
                       std::string(labels.status().message()),
                       {{"collection", shape.collection}, {"shape", shape.id}});
    }
    answer.labels = *std::move(labels);
  }
  answer.record = std::move(stored.record);
  return answer;
}

absl::StatusOr<SearchAnswer> Engine::Search(const SearchQuery& query,
                                            const StopToken& stop) const {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  return parts_->search.Search(query, stop);
}

absl::StatusOr<ComparedShapes> Engine::Compare(const CompareQuery& query,
                                               const StopToken& stop) const {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  return parts_->search.Compare(query, stop);
}

IndexState Engine::index_state() const { return parts_->gallery.state(); }

void Engine::WatchIndexState(std::function<void(IndexState)> watcher) {
  parts_->gallery.Watch(std::move(watcher));
}

absl::Status Engine::WaitUntilServing(const StopToken& stop) const {
  return parts_->gallery.WaitUntilServing(stop);
}

StoreLoad Engine::Store() const { return parts_->catalog->Load(); }

std::vector<CollectionHealth> Engine::Health() const {
  return parts_->gallery.Health();
}

}  // namespace argmesh
