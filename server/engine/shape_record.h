// What is known of a stored shape beside its graph and its mesh.
#ifndef ARGMESH_SERVER_ENGINE_SHAPE_RECORD_H_
#define ARGMESH_SERVER_ENGINE_SHAPE_RECORD_H_

#include <cstdint>
#include <map>
#include <string>

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

  int64_t generation = 0;  // of the collection, when last written
  absl::Time create_time;
  absl::Time update_time;
};

// Changes with every write of the shape.
std::string ShapeEtag(const ShapeRecord& record);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SHAPE_RECORD_H_
