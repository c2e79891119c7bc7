// What a request may say, checked before anything is done.
//
// Fails    kInvalidArgument NAME_INVALID or FIELD_INVALID with the field
#ifndef ARGMESH_SERVER_ENGINE_REQUEST_RULES_H_
#define ARGMESH_SERVER_ENGINE_REQUEST_RULES_H_

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "core/graph/shape_graph.h"
#include "server/engine/collection_record.h"
#include "server/engine/search_requests.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

inline constexpr size_t kMaxDisplayNameBytes = 256;
inline constexpr size_t kMaxSourceUriBytes = 2048;
inline constexpr size_t kMaxMetadataEntries = 64;
inline constexpr size_t kMaxMetadataKeyBytes = 64;
inline constexpr size_t kMaxMetadataValueBytes = 1024;
inline constexpr size_t kMaxMetadataBytes = 16 << 10;  // keys and values
inline constexpr int kMaxSearchLimit = 1000;
inline constexpr int kMaxCandidates = 1'000'000;

// `field` names it in the error.
absl::Status CheckId(std::string_view field, std::string_view id);
absl::Status CheckShapeRef(const ShapeRef& shape);
absl::Status CheckText(std::string_view field, std::string_view text,
                       size_t max_bytes);
absl::Status CheckMetadata(const std::map<std::string, std::string>& metadata);
absl::Status CheckSettings(const CollectionSettings& settings);
absl::Status CheckNewCollection(const NewCollection& spec);
absl::Status CheckNewShape(const NewShape& shape);
absl::Status CheckPatch(const ShapePatch& patch);
absl::Status CheckSearchQuery(const SearchQuery& query);
// Each is the name of a level of `query`.
absl::Status CheckLevels(const std::vector<std::string>& levels,
                         const ShapeGraph& query);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_REQUEST_RULES_H_
