// A collection: shapes abstracted with the same settings, searched together.
#ifndef ARGMESH_SERVER_ENGINE_COLLECTION_RECORD_H_
#define ARGMESH_SERVER_ENGINE_COLLECTION_RECORD_H_

#include <cstdint>
#include <string>
#include <vector>

#include "absl/time/time.h"
#include "core/abstraction/decomposition.h"
#include "server/engine/metadata_key.h"

namespace argmesh {

// Of every graph of the collection: graphs of different settings are not
// comparable. Changed for all shapes at once (Catalog::SwitchSettings).
struct CollectionSettings {
  // Not kGiven: labels cannot be stored as a setting.
  DecompositionKind decomposition = DecompositionKind::kBiharmonic;
  int32_t vertex_budget = 3000;  // 100 .. 100,000 samples of a surface
  int32_t uniform_cells = 32;    // 0 .. 1000 cells beside the components
  bool store_meshes = true;      // false: keep graphs and labels only

  friend bool operator==(const CollectionSettings&,
                         const CollectionSettings&) = default;
};

// Whether both make the same graph of a mesh: graphs of the one may be compared
// with those of the other.
inline bool MakeSameGraphs(CollectionSettings a, const CollectionSettings& b) {
  a.store_meshes = b.store_meshes;  // says nothing about graphs
  return a == b;
}

struct CollectionRecord {
  std::string id;
  std::string uid;  // UUID; another one when the id is deleted and made again
  std::string display_name;
  CollectionSettings settings;
  std::vector<MetadataKey> metadata_keys;  // the declared ones
  uint32_t graph_version = 0;              // of the graphs that it takes
  int64_t generation = 0;   // +1 for every shape written or deleted
  int64_t shape_count = 0;  // in the same read as the generation
  int64_t revision = 1;     // +1 for every update of the record itself
  absl::Time create_time;
  absl::Time update_time;

  friend bool operator==(const CollectionRecord&,
                         const CollectionRecord&) = default;
};

// Changes with every update of the record itself, not with its shapes.
std::string CollectionEtag(const CollectionRecord& record);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_COLLECTION_RECORD_H_
