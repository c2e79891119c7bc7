// The errors every implementation of Catalog answers with.
#ifndef ARGMESH_SERVER_ENGINE_CATALOG_ERRORS_H_
#define ARGMESH_SERVER_ENGINE_CATALOG_ERRORS_H_

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "core/base/sha256.h"
#include "server/engine/metadata_key.h"

namespace argmesh {

absl::Status CollectionNotFoundError(std::string_view id);
absl::Status CollectionExistsError(std::string_view id);
absl::Status CollectionNotEmptyError(std::string_view id);
absl::Status ShapeNotFoundError(std::string_view collection,
                                std::string_view id);
absl::Status ShapeExistsError(std::string_view collection, std::string_view id);
absl::Status RequestIdReusedError(std::string_view request_id);
absl::Status CatalogClosedError();
// kGraphVersionMismatch: a graph made with other settings than the collection
// has, or is to get.
absl::Status OtherSettingsError(std::string_view id);
// OK when a shape that has the mesh `stored` is what `of` was made from.
absl::Status CheckStagedMesh(const Sha256Digest& of,
                             const Sha256Digest& stored);
// OK when `asked` is empty or the stored one.
absl::Status CheckEtag(std::string_view asked, std::string_view stored);

// FIELD_INVALID `metadata_keys`: the stored shape has a value that is not of
// the type that is to be declared.
absl::Status CheckStoredValues(
    const std::vector<MetadataKey>& keys, std::string_view shape,
    const std::map<std::string, std::string>& metadata);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_CATALOG_ERRORS_H_
