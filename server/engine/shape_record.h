// What is known of a stored shape beside its graph and its mesh.
#ifndef ARGMESH_SERVER_ENGINE_SHAPE_RECORD_H_
#define ARGMESH_SERVER_ENGINE_SHAPE_RECORD_H_

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "absl/time/time.h"
#include "core/base/sha256.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_report.h"

namespace argmesh {

// Shapes are added in one step and are kActive from their first commit on; the
// other states belong to shapes that a background job works on.
enum class ShapeState {
  kPending = 1,
  kProcessing = 2,
  kActive = 3,
  kFailed = 4,
};

// The stored graph in numbers.
struct GraphSummary {
  struct Level {
    std::string name;  // as LevelNames
    int32_t nodes = 0;
    int32_t edges = 0;
    friend bool operator==(const Level&, const Level&) = default;
  };
  uint32_t version = 0;
  std::vector<Level> levels;  // coarse to fine, then "uniform" if it is there
  int32_t modes = 0;

  friend bool operator==(const GraphSummary&, const GraphSummary&) = default;
};

struct ShapeRecord {
  std::string collection;
  std::string id;
  std::string uid;  // UUID; kept when the shape is replaced
  std::string display_name;
  std::string source_uri;
  std::map<std::string, std::string> metadata;

  ShapeState state = ShapeState::kActive;
  std::string error;  // why, when kFailed

  Sha256Digest sha256{};  // of the mesh file's bytes
  int64_t size_bytes = 0;
  MeshFormat format = MeshFormat::kUnknown;
  bool mesh_stored = false;  // the file can be downloaded
  MeshReport report;
  GraphSummary graph;

  int64_t generation = 0;  // of the collection, when last written
  absl::Time create_time;
  absl::Time update_time;
};

// Changes with every write of the shape.
std::string ShapeEtag(const ShapeRecord& record);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SHAPE_RECORD_H_
