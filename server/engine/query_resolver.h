// From what a request asks about to what can be matched.
#ifndef ARGMESH_SERVER_ENGINE_QUERY_RESOLVER_H_
#define ARGMESH_SERVER_ENGINE_QUERY_RESOLVER_H_

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/sha256.h"
#include "core/base/stop_token.h"
#include "core/containment/window_set.h"
#include "core/graph/shape_graph.h"
#include "core/mesh/triangle_mesh.h"
#include "core/signature/shape_signature.h"
#include "server/engine/catalog.h"
#include "server/engine/engine_options.h"
#include "server/engine/mesh_analysis.h"
#include "server/engine/mesh_memory.h"
#include "server/engine/mesh_store.h"
#include "server/engine/search_requests.h"

namespace argmesh {

// What a query is matched by, beside its graph.
struct QueryNeeds {
  bool signature = false;
  bool windows = false;  // with the surface
  bool surface = false;
};

// A mesh as it came, and the nodes that its faces belong to.
struct LabelledSurface {
  TriangleMesh mesh;
  FaceLabels labels;
};

// A stored shape with its mesh.
struct StoredSurface {
  Sha256Digest sha256 = {};  // of the mesh
  ShapeGraph graph;
  LabelledSurface surface;
};

struct ResolvedQuery {
  QueryGraph graph;
  std::optional<ShapeSignature> signature;  // as needed, never of a bare graph
  std::optional<QueryWindows> windows;      // as needed, never of a bare graph
  std::optional<LabelledSurface> surface;   // as needed, never of a bare graph
  std::optional<Sha256Digest> sha256;       // of a mesh as it came, whole
};

class QueryResolver {
 public:
  // All must outlive it.
  QueryResolver(const EngineOptions& options, const Catalog& catalog,
                const MeshStore& meshes, MeshMemory& memory)
      : options_(options),
        analyzer_(options, memory, options.pool.max_wait),
        catalog_(catalog),
        meshes_(meshes) {}

  // Fails    kGraphVersionMismatch  a stored shape's collection has other
  //          settings than `settings`, or another version computed it
  //          kMeshNotStored  windows or surface of a stored shape whose mesh is
  //          not kept
  //          kGraphInvalid; as MeshAnalyzer
  absl::StatusOr<ResolvedQuery> Resolve(const QueryShape& shape,
                                        const CollectionSettings& settings,
                                        const QueryNeeds& needs,
                                        const StopToken& stop) const;

  // The part of a stored shape's mesh that its finest components `nodes` are,
  // as a shape of its own.
  //
  // Fails    kNodeNotFound, kMeshNotStored; as Resolve
  absl::StatusOr<ResolvedQuery> ResolveRegion(
      const ShapeRef& shape, std::span<const int32_t> nodes,
      const CollectionSettings& settings, const QueryNeeds& needs,
      const StopToken& stop) const;

  // Fails    kMeshNotStored, kGraphVersionMismatch, kStoredDataDamaged
  absl::StatusOr<StoredSurface> ReadSurface(
      const ShapeRef& shape, const CollectionSettings& settings) const;

 private:
  absl::StatusOr<StoredGraph> ReadGraph(const ShapeRef& shape,
                                        const CollectionSettings& settings,
                                        bool with_labels) const;
  absl::StatusOr<ResolvedQuery> ResolveStored(
      const ShapeRef& shape, const CollectionSettings& settings,
      const QueryNeeds& needs, const StopToken& stop) const;
  absl::StatusOr<TriangleMesh> ReadMesh(const ShapeRecord& record) const;
  absl::StatusOr<LabelledSurface> ReadLabelledSurface(
      const StoredGraph& stored) const;  // read with its labels

  const EngineOptions& options_;
  const MeshAnalyzer analyzer_;
  const Catalog& catalog_;
  const MeshStore& meshes_;
};

// The stored bytes as a graph. kGraphVersionMismatch, kStoredDataDamaged.
absl::StatusOr<ShapeGraph> ParseStoredGraph(const StoredGraph& stored);

// kMeshNotStored.
absl::Status MeshNotStoredError(const ShapeRecord& record);

// The bytes of a stored shape's file. kMeshNotStored, kStoredDataDamaged.
absl::StatusOr<std::string> ReadMeshFile(const MeshStore& meshes,
                                         const ShapeRecord& record);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_QUERY_RESOLVER_H_
