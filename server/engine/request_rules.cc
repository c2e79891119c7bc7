#include "server/engine/request_rules.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "core/base/identifier.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/engine/utf8.h"

namespace argmesh {
namespace {

absl::Status FieldInvalid(std::string_view field, const std::string& why) {
  const std::string name(field);
  return MakeError(ErrorReason::kFieldInvalid, name + " " + why,
                   {{"field", name}});
}

absl::Status CheckRange(std::string_view field, double value, double low,
                        double high) {
  if (value >= low && value <= high) return absl::OkStatus();  // not NaN
  return FieldInvalid(
      field, absl::StrFormat("is %g, must be %g .. %g", value, low, high));
}

}  // namespace

absl::Status CheckId(std::string_view field, std::string_view id) {
  absl::Status status = CheckIdentifier(field, id);
  if (status.ok()) return status;
  return MakeError(ErrorReason::kNameInvalid, std::string(status.message()),
                   {{"field", std::string(field)}});
}

absl::Status CheckShapeRef(const ShapeRef& shape) {
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", shape.collection));
  return CheckId("shape", shape.id);
}

absl::Status CheckText(std::string_view field, std::string_view text,
                       size_t max_bytes) {
  if (text.size() > max_bytes) {
    return FieldInvalid(field, absl::StrFormat("has %d bytes, more than %d",
                                               text.size(), max_bytes));
  }
  if (!IsUtf8(text)) return FieldInvalid(field, "is not UTF-8");
  return absl::OkStatus();
}

absl::Status CheckMetadata(const std::map<std::string, std::string>& metadata) {
  if (metadata.size() > kMaxMetadataEntries) {
    return FieldInvalid("metadata",
                        absl::StrFormat("has %d entries, more than %d",
                                        metadata.size(), kMaxMetadataEntries));
  }
  size_t bytes = 0;
  for (const auto& [key, value] : metadata) {
    bytes += key.size() + value.size();
    if (key.empty()) return FieldInvalid("metadata", "has an empty key");
    ARGMESH_RETURN_IF_ERROR(
        CheckText("metadata key", key, kMaxMetadataKeyBytes));
    ARGMESH_RETURN_IF_ERROR(
        CheckText("metadata value", value, kMaxMetadataValueBytes));
  }
  if (bytes > kMaxMetadataBytes) {
    return FieldInvalid("metadata",
                        absl::StrFormat("has %d bytes, more than %d", bytes,
                                        kMaxMetadataBytes));
  }
  return absl::OkStatus();
}

absl::Status CheckLevels(const std::vector<std::string>& levels,
                         const ShapeGraph& query) {
  const std::vector<std::string> names = LevelNames(query);
  for (const std::string& level : levels) {
    if (std::find(names.begin(), names.end(), level) == names.end()) {
      return FieldInvalid("parameters.levels",
                          absl::StrCat(level, " is not among the query's: ",
                                       absl::StrJoin(names, ", ")));
    }
  }
  return absl::OkStatus();
}

absl::Status CheckSettings(const CollectionSettings& settings) {
  if (settings.decomposition == DecompositionKind::kGiven) {
    return FieldInvalid("settings.decomposition", "cannot be GIVEN");
  }
  ARGMESH_RETURN_IF_ERROR(CheckRange("settings.vertex_budget",
                                     settings.vertex_budget, 100, 100'000));
  return CheckRange("settings.uniform_cells", settings.uniform_cells, 0, 1000);
}

absl::Status CheckNewCollection(const NewCollection& spec) {
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", spec.id));
  ARGMESH_RETURN_IF_ERROR(
      CheckText("display_name", spec.display_name, kMaxDisplayNameBytes));
  ARGMESH_RETURN_IF_ERROR(CheckMetadataKeys(spec.metadata_keys));
  return CheckSettings(spec.settings);
}

absl::Status CheckNewShape(const NewShape& shape) {
  ARGMESH_RETURN_IF_ERROR(CheckShapeRef({shape.collection, shape.id}));
  ARGMESH_RETURN_IF_ERROR(
      CheckText("display_name", shape.display_name, kMaxDisplayNameBytes));
  ARGMESH_RETURN_IF_ERROR(
      CheckText("source_uri", shape.source_uri, kMaxSourceUriBytes));
  return CheckMetadata(shape.metadata);
}

absl::Status CheckPatch(const ShapePatch& patch) {
  ARGMESH_RETURN_IF_ERROR(CheckShapeRef({patch.collection, patch.id}));
  if (patch.display_name) {
    ARGMESH_RETURN_IF_ERROR(
        CheckText("display_name", *patch.display_name, kMaxDisplayNameBytes));
  }
  if (patch.source_uri) {
    ARGMESH_RETURN_IF_ERROR(
        CheckText("source_uri", *patch.source_uri, kMaxSourceUriBytes));
  }
  if (patch.metadata) return CheckMetadata(*patch.metadata);
  return absl::OkStatus();
}

absl::Status CheckSearchQuery(const SearchQuery& query) {
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", query.collection));
  ARGMESH_RETURN_IF_ERROR(CheckRange("limit", query.limit, 1, kMaxSearchLimit));
  ARGMESH_RETURN_IF_ERROR(
      CheckRange("candidates", query.candidates, 0, kMaxCandidates));
  if (!query.region_nodes.empty() &&
      !std::holds_alternative<ShapeRef>(query.query)) {
    return MakeError(ErrorReason::kFieldInvalid,
                     "region_node_ids: needs a stored shape as the query",
                     {{"field", "region_node_ids"}});
  }
  ARGMESH_RETURN_IF_ERROR(CheckRange("min_score", query.min_score, 0, 1));
  return CheckRange("min_query_coverage", query.min_query_coverage, 0, 1);
}

}  // namespace argmesh
