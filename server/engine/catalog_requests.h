// What the functions of Catalog take and give.
#ifndef ARGMESH_SERVER_ENGINE_CATALOG_REQUESTS_H_
#define ARGMESH_SERVER_ENGINE_CATALOG_REQUESTS_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "core/base/sha256.h"
#include "server/engine/collection_record.h"
#include "server/engine/settings_stage.h"
#include "server/engine/shape_record.h"

namespace argmesh {

// Makes a retried write return the first answer (AIP-155). Kept with the write
// in one transaction; an empty `request_id` asks for nothing.
struct RequestStamp {
  std::string principal;   // whose id it is
  std::string request_id;  // a UUID
  std::string method;
  Sha256Digest hash{};     // of everything the request asks for
  absl::Time expire_time;  // forgotten after it
};

struct CollectionPatch {
  std::string id;
  std::optional<std::string> display_name;
  std::optional<std::vector<MetadataKey>> metadata_keys;  // all of them
  std::optional<uint32_t> graph_version;
  std::string etag;  // empty: any
  absl::Time update_time;
  RequestStamp request = {};
};

struct CollectionDelete {
  std::string id;
  bool force = false;  // with its shapes
  std::string etag;    // empty: any
  RequestStamp request = {};
};

struct CollectionDeleted {
  std::string uid;
  std::vector<Sha256Digest> unreferenced;  // meshes no row names any more
};

struct RemovedShapes {
  bool more = false;  // call again: something may be left
  std::vector<Sha256Digest> unreferenced;
};

// What becomes of a shape whose id is taken.
enum class IfExists {
  kFail,        // kShapeExists
  kReturnSame,  // the stored shape when its SHA-256 is the same, else as kFail
  kReplace,     // the new one takes its place; uid and create time stay
};

// What describes a shape's surface beside its graph: sealed bytes that the
// catalog stores as they are; all empty when the shape has none.
struct SurfaceDescriptors {
  std::string signature;     // of the whole
  std::string window_words;  // of its windows, for the index
  std::string windows;       // read one shape at a time, ReadWindows
};

struct ShapePut {
  // Comes with uid and times; the generation is given by the catalog.
  ShapeRecord record;
  std::string collection_uid;
  CollectionSettings settings;  // that the graph was made with
  uint32_t graph_version = 0;
  std::string graph;   // SerializeShapeGraph
  std::string labels;  // SerializeFaceLabels
  SurfaceDescriptors descriptors;
  // Put aside with it when the collection is at this stage.
  std::optional<StagedDescription> staged;
  IfExists if_exists = IfExists::kFail;
  std::string etag;  // of the shape to be replaced; empty: any
  RequestStamp request;
};

// A piece of a list of shapes.
struct ShapeSlice {
  std::string after_id;  // begins with the next id; empty: with the first
  int limit = 0;
  std::string filter;  // MetadataFilter over the declared keys; empty: all
};

struct ShapeWritten {
  ShapeRecord record;
  std::string collection_uid;
  bool written = true;  // false: was stored already, by kReturnSame or a retry
  std::vector<Sha256Digest> unreferenced;  // as above
};

struct ShapePatch {
  std::string collection;
  std::string id;
  std::optional<std::string> display_name;
  std::optional<std::string> source_uri;
  std::optional<std::map<std::string, std::string>> metadata;
  std::string etag;  // empty: any
  absl::Time update_time;
  RequestStamp request = {};
};

struct ShapeDelete {
  std::string collection;
  std::string id;
  std::string etag;  // empty: any
  RequestStamp request;
};

struct ShapesDelete {
  std::string collection;
  std::vector<std::string> ids;  // each once
  RequestStamp request = {};
};

struct ShapeDeleted {
  std::string collection_uid;
  int64_t generation = 0;  // of the collection without it
  std::vector<Sha256Digest> unreferenced;
};

struct StoredGraph {
  ShapeRecord record;
  CollectionSettings settings;  // that it was made with
  uint32_t graph_version = 0;
  std::string graph;
  std::string signature;  // empty: the shape has none
  std::string labels;     // empty when not asked for
};

struct ScannedGraph {
  ShapeRecord record;
  CollectionSettings settings;  // that it was made with
  uint32_t graph_version = 0;
  std::string graph;
  std::string signature;     // empty: the shape has none
  std::string window_words;  // empty: the shape has none
  absl::Status status;       // kStoredDataDamaged: all bytes are empty
};

struct ShapeChange {
  // kSwitch: every shape got its description of other settings.
  enum class Kind { kPut = 1, kDelete = 2, kSwitch = 3 };
  int64_t generation = 0;
  std::string id;  // empty of kSwitch
  Kind kind = Kind::kPut;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_CATALOG_REQUESTS_H_
