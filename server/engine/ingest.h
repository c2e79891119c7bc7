// Adding a shape: check, analyse, publish the mesh, commit, index.
//
// The order makes a shape durable and searchable when AddShape returns, and
// leaves neither row nor mesh behind when it fails.
#ifndef ARGMESH_SERVER_ENGINE_INGEST_H_
#define ARGMESH_SERVER_ENGINE_INGEST_H_

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/matching/match.h"
#include "server/engine/catalog.h"
#include "server/engine/engine_options.h"
#include "server/engine/gallery.h"
#include "server/engine/mesh_analysis.h"
#include "server/engine/mesh_memory.h"
#include "server/engine/mesh_store.h"
#include "server/engine/mesh_upload.h"
#include "server/engine/running_reindexes.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

class Ingest {
 public:
  // All must outlive it.
  Ingest(const EngineOptions& options, Catalog& catalog, MeshStore& meshes,
         Gallery& gallery, const RunningReindexes& running, MeshMemory& memory);

  absl::StatusOr<AddedShape> AddShape(const NewShape& shape, MeshSource mesh,
                                      const StopToken& stop);

  // Describes a stored shape anew from its mesh, unless the shape has changed
  // meanwhile. kMeshNotStored, kEtagMismatch, kShapeNotFound.
  absl::Status DescribeAnew(const CollectionRecord& collection,
                            const ShapeRecord& stored, const StopToken& stop);

  // Describes a stored shape with other settings, and puts that aside.
  // kMeshNotStored, kEtagMismatch when it has another mesh by then,
  // kShapeNotFound, kGraphVersionMismatch.
  absl::Status PutAside(const CollectionRecord& collection,
                        const ShapeRecord& stored,
                        const CollectionSettings& settings,
                        const StopToken& stop);

  // Removes meshes that rows no longer name. What cannot be removed now is
  // left to the sweep of the next start.
  void RemoveMeshes(const std::vector<Sha256Digest>& unreferenced);

  MeshStore::IsReferenced is_referenced() const;

 private:
  struct Source;      // bytes and what is known of them
  struct Searchable;  // what the index takes of a shape
  struct Described;   // what the catalog and the index take of it

  absl::StatusOr<Source> Open(const NewShape& shape, MeshSource mesh) const;
  absl::StatusOr<std::optional<AddedShape>> FindStored(
      const NewShape& shape, const Sha256Digest& sha256,
      const RequestStamp& request) const;
  absl::StatusOr<MeshPin> PublishMesh(Source& source);
  absl::StatusOr<Described> Describe(const NewShape& shape,
                                     const CollectionRecord& collection,
                                     const Source& source,
                                     const StopToken& stop) const;
  absl::StatusOr<StagedDescription> DescribeWith(
      const CollectionSettings& settings, const std::string& bytes,
      MeshFormat format, const StopToken& stop) const;
  absl::StatusOr<AddedShape> Store(const NewShape& shape, Source& source,
                                   Described described, const StopToken& stop);
  absl::StatusOr<AddedShape> CommitAsIs(const NewShape& shape,
                                        const Source& source,
                                        Described described,
                                        const StopToken& stop);
  absl::StatusOr<AddedShape> Commit(const ShapePut& put, Searchable searchable);

  const EngineOptions& options_;
  const MeshAnalyzer analyzer_;
  Catalog& catalog_;
  MeshStore& meshes_;
  Gallery& gallery_;
  const RunningReindexes& running_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_INGEST_H_
