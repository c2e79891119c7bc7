// What is put aside while a collection gets other settings, and the switch.
#ifndef ARGMESH_SERVER_ENGINE_SETTINGS_STAGE_H_
#define ARGMESH_SERVER_ENGINE_SETTINGS_STAGE_H_

#include <cstdint>
#include <string>

#include "absl/time/time.h"
#include "core/base/sha256.h"
#include "server/engine/collection_record.h"
#include "server/engine/shape_record.h"

namespace argmesh {

// Settings that a collection is to be switched to, and the version of what is
// computed with them.
struct SettingsStage {
  CollectionSettings settings;
  uint32_t graph_version = 0;

  friend bool operator==(const SettingsStage&, const SettingsStage&) = default;
};

// What a shape is with the settings of a stage.
struct StagedDescription {
  SettingsStage stage;
  MeshReport report;
  GraphSummary summary;
  std::string graph;   // SerializeShapeGraph
  std::string labels;  // SerializeFaceLabels
};

// Puts aside what a shape is with other settings.
struct ShapeStaging {
  std::string collection;
  std::string collection_uid;
  std::string id;
  Sha256Digest sha256{};  // of the mesh it was made from
  StagedDescription description;
};

struct SettingsSwitch {
  std::string collection;
  std::string collection_uid;
  SettingsStage stage;
  absl::Time update_time;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SETTINGS_STAGE_H_
