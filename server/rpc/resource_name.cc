#include "server/rpc/resource_name.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/identifier.h"
#include "core/base/status_macros.h"
#include "core/base/utf8_prefix.h"
#include "server/engine/error_reason.h"
#include "server/engine/uid.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

// Names come back in messages; a hostile one must not fill the log.
constexpr size_t kMaxShownLength = 200;

absl::Status NameInvalid(std::string_view field, std::string_view name,
                         std::string_view pattern) {
  return MakeError(
      ErrorReason::kNameInvalid,
      absl::StrFormat("%s: '%s' is not of the form %s", std::string(field),
                      std::string(Utf8Prefix(name, kMaxShownLength)),
                      std::string(pattern)),
      {{"field", std::string(field)}});
}

// The ids of `name` when it is words[0]/id/words[1]/id ...; else nothing.
std::vector<std::string> IdsOf(std::string_view name,
                               const std::vector<std::string>& words) {
  std::vector<std::string> ids;
  for (const std::string& word : words) {
    if (!ids.empty()) {
      if (!name.starts_with('/')) return {};
      name.remove_prefix(1);
    }
    const std::string prefix = word + "/";
    if (!name.starts_with(prefix)) return {};
    name.remove_prefix(prefix.size());
    const std::string_view id = name.substr(0, name.find('/'));
    if (!IsIdentifier(id)) return {};
    ids.emplace_back(id);
    name.remove_prefix(id.size());
  }
  if (!name.empty()) return {};
  return ids;
}

}  // namespace

absl::StatusOr<std::string> ParseCollectionName(std::string_view field,
                                                std::string_view name) {
  if (name.empty()) return FieldRequired(field);
  const auto ids = IdsOf(name, {"collections"});
  if (ids.empty()) return NameInvalid(field, name, "collections/{collection}");
  return ids[0];
}

absl::StatusOr<ShapeRef> ParseShapeName(std::string_view field,
                                        std::string_view name) {
  if (name.empty()) return FieldRequired(field);
  const auto ids = IdsOf(name, {"collections", "shapes"});
  if (ids.empty()) {
    return NameInvalid(field, name, "collections/{collection}/shapes/{shape}");
  }
  return ShapeRef{.collection = ids[0], .id = ids[1]};
}

absl::StatusOr<std::string> ParseSnapshotName(std::string_view field,
                                              std::string_view name) {
  if (name.empty()) return FieldRequired(field);
  const auto ids = IdsOf(name, {"snapshots"});
  if (ids.empty()) return NameInvalid(field, name, "snapshots/{snapshot}");
  return ids[0];
}

absl::StatusOr<std::string> ParseOperationName(std::string_view field,
                                               std::string_view name) {
  constexpr std::string_view kPrefix = "operations/";
  if (name.empty()) return FieldRequired(field);
  if (!name.starts_with(kPrefix) || !IsUid(name.substr(kPrefix.size()))) {
    return NameInvalid(field, name, "operations/{uuid}");
  }
  return std::string(name.substr(kPrefix.size()));
}

absl::Status CheckResourceId(std::string_view field, std::string_view id) {
  if (id.empty()) return FieldRequired(field);
  if (IsIdentifier(id)) return absl::OkStatus();
  return NameInvalid(field, id, "[a-z]([a-z0-9-]{0,61}[a-z0-9])?");
}

std::string CollectionName(std::string_view collection) {
  return "collections/" + std::string(collection);
}

std::string ShapeName(std::string_view collection, std::string_view shape) {
  return CollectionName(collection) + "/shapes/" + std::string(shape);
}

std::string SnapshotName(std::string_view snapshot) {
  return "snapshots/" + std::string(snapshot);
}

std::string OperationName(std::string_view operation) {
  return "operations/" + std::string(operation);
}

}  // namespace argmesh
