// What the engine's functions on collections and shapes take and give.
#ifndef ARGMESH_SERVER_ENGINE_SHAPE_REQUESTS_H_
#define ARGMESH_SERVER_ENGINE_SHAPE_REQUESTS_H_

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/sha256.h"
#include "core/graph/shape_graph.h"
#include "core/mesh/mesh_format.h"
#include "server/engine/catalog_requests.h"
#include "server/engine/collection_record.h"
#include "server/engine/shape_record.h"

namespace argmesh {

// An idempotency key of a write; `request_id` empty: none.
struct RequestKey {
  std::string principal;
  std::string request_id;  // a UUID in its text form, any case
};

struct NewCollection {
  std::string id;
  std::string display_name;
  CollectionSettings settings;
  std::vector<MetadataKey> metadata_keys;
  RequestKey request;
};

struct NewShape {
  std::string collection;
  std::string id;
  std::string display_name;                     // at most 256 bytes
  std::string source_uri;                       // at most 2048 bytes
  std::map<std::string, std::string> metadata;  // <= 64 keys, 16 KiB in all
  MeshFormat format = MeshFormat::kUnknown;     // kUnknown: from the bytes
  std::optional<Sha256Digest> sha256;           // checked when given
  IfExists if_exists = IfExists::kFail;
  std::string etag;  // kReplace: of the shape to be replaced; empty: any
  RequestKey request;
};

// Of a folder's files, as shapes.
struct FolderImport {
  std::string collection;
  std::string folder;  // of an ImportSource
  IfExists if_exists = IfExists::kFail;
};

struct AddedShape {
  ShapeRecord record;
  bool already_stored = false;  // by an earlier call; nothing was written
};

struct PageRequest {
  int page_size = 0;            // 0: 100; above 1000 means 1000; < 0 is refused
  std::string page_token;       // empty: the first page
  int64_t max_bytes = 3 << 20;  // a page ends before it, after one item
};

struct CollectionPage {
  std::vector<CollectionRecord> collections;
  std::string next_page_token;  // empty: that was the last
};

struct ShapePage {
  std::vector<ShapeRecord> shapes;
  std::string next_page_token;
};

struct ShapeRef {
  std::string collection;
  std::string id;
};

struct ShapeRemoval {
  ShapeRef shape;
  std::string etag;  // empty: any
  RequestKey request;
};

struct ShapeGraphAnswer {
  ShapeRecord record;
  ShapeGraph graph;
  FaceLabels labels;  // empty when not asked for
};

// How much of a collection a search can see.
struct CollectionHealth {
  std::string id;
  bool loaded = false;
  int64_t generation = 0;       // that the index has reached
  int64_t shapes = 0;           // in the index
  int64_t damaged_shapes = 0;   // stored, but fail their check
  int64_t outdated_shapes = 0;  // graphs of another version
  std::string error;            // why it could not be loaded
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SHAPE_REQUESTS_H_
