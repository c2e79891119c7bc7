#include "server/rpc/convert_update.h"

#include <algorithm>
#include <string>
#include <vector>

#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "core/base/status_macros.h"
#include "core/base/utf8_prefix.h"
#include "server/rpc/convert_collection.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

// Of a path in a message.
constexpr size_t kMaxShownPath = 100;

struct Changeable {
  std::string field;
  bool set;  // in the resource
};

// The fields that change.
absl::StatusOr<std::vector<std::string>> FieldsOf(
    const google::protobuf::FieldMask& mask,
    const std::vector<Changeable>& changeable) {
  std::vector<std::string> fields;
  const bool all = mask.paths_size() == 1 && mask.paths(0) == "*";
  for (const Changeable& candidate : changeable) {
    if (all || (mask.paths_size() == 0 && candidate.set)) {
      fields.push_back(candidate.field);
    }
  }
  if (all) return fields;
  for (const std::string& path : mask.paths()) {
    const bool known = std::any_of(
        changeable.begin(), changeable.end(),
        [&](const Changeable& candidate) { return candidate.field == path; });
    if (!known) {
      return FieldInvalid(
          "update_mask",
          absl::StrFormat(
              "\"%s\" may not change; these may: %s",
              std::string(Utf8Prefix(path, kMaxShownPath)),
              absl::StrJoin(changeable, ", ",
                            [](std::string* out, const Changeable& candidate) {
                              *out += candidate.field;
                            })));
    }
    fields.push_back(path);
  }
  if (fields.empty()) return FieldInvalid("update_mask", "nothing changes");
  return fields;
}

bool Has(const std::vector<std::string>& fields, const char* field) {
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

}  // namespace

absl::StatusOr<CollectionPatch> FromProto(
    const v1::UpdateCollectionRequest& request) {
  const v1::Collection& collection = request.collection();
  CollectionPatch patch;
  ARGMESH_ASSIGN_OR_RETURN(
      patch.id, ParseCollectionName("collection.name", collection.name()));
  ARGMESH_ASSIGN_OR_RETURN(
      const std::vector<std::string> fields,
      FieldsOf(request.update_mask(),
               {{"display_name", !collection.display_name().empty()},
                {"metadata_keys", !collection.metadata_keys().empty()}}));
  if (Has(fields, "display_name")) {
    patch.display_name = collection.display_name();
  }
  if (Has(fields, "metadata_keys")) {
    ARGMESH_ASSIGN_OR_RETURN(
        patch.metadata_keys,
        FromProto("collection.metadata_keys", collection.metadata_keys()));
  }
  patch.etag = collection.etag();
  return patch;
}

absl::StatusOr<ShapePatch> FromProto(const v1::UpdateShapeRequest& request) {
  const v1::Shape& shape = request.shape();
  ARGMESH_ASSIGN_OR_RETURN(const ShapeRef name,
                           ParseShapeName("shape.name", shape.name()));
  ARGMESH_ASSIGN_OR_RETURN(
      const std::vector<std::string> fields,
      FieldsOf(request.update_mask(),
               {{"display_name", !shape.display_name().empty()},
                {"source_uri", !shape.source_uri().empty()},
                {"metadata", !shape.metadata().empty()}}));
  ShapePatch patch;
  patch.collection = name.collection;
  patch.id = name.id;
  if (Has(fields, "display_name")) patch.display_name = shape.display_name();
  if (Has(fields, "source_uri")) patch.source_uri = shape.source_uri();
  if (Has(fields, "metadata")) {
    patch.metadata.emplace(shape.metadata().begin(), shape.metadata().end());
  }
  patch.etag = shape.etag();
  return patch;
}

}  // namespace argmesh
