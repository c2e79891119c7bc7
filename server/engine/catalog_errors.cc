#include "server/engine/catalog_errors.h"

#include <string>

#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

absl::Status OfCollection(ErrorReason reason, std::string_view id,
                          const char* what) {
  const std::string name(id);
  return MakeError(reason, "collection " + name + what, {{"collection", name}});
}

absl::Status OfShape(ErrorReason reason, std::string_view collection,
                     std::string_view id, const char* what) {
  const std::string of(collection);
  const std::string name(id);
  return MakeError(reason, "shape " + name + " of collection " + of + what,
                   {{"collection", of}, {"shape", name}});
}

}  // namespace

absl::Status CollectionNotFoundError(std::string_view id) {
  return OfCollection(ErrorReason::kCollectionNotFound, id, " does not exist");
}

absl::Status CollectionExistsError(std::string_view id) {
  return OfCollection(ErrorReason::kCollectionExists, id, " exists already");
}

absl::Status CollectionNotEmptyError(std::string_view id) {
  return OfCollection(ErrorReason::kCollectionNotEmpty, id,
                      " has shapes; delete it with force");
}

absl::Status ShapeNotFoundError(std::string_view collection,
                                std::string_view id) {
  return OfShape(ErrorReason::kShapeNotFound, collection, id,
                 " does not exist");
}

absl::Status ShapeExistsError(std::string_view collection,
                              std::string_view id) {
  return OfShape(ErrorReason::kShapeExists, collection, id, " exists already");
}

absl::Status RequestIdReusedError(std::string_view request_id) {
  return MakeError(ErrorReason::kRequestIdReused,
                   "request_id " + std::string(request_id) +
                       " was used for another request before",
                   {{"field", "request_id"}});
}

absl::Status CatalogClosedError() {
  return WithRetryDelay(
      MakeError(ErrorReason::kDraining, "the catalog is closed"),
      absl::Seconds(1));
}

absl::Status OtherSettingsError(std::string_view id) {
  return OfCollection(ErrorReason::kGraphVersionMismatch, id,
                      " has other settings: its graphs cannot be compared");
}

absl::Status CheckStagedMesh(const Sha256Digest& of,
                             const Sha256Digest& stored) {
  if (of == stored) return absl::OkStatus();
  return MakeError(ErrorReason::kEtagMismatch,
                   "the shape has another mesh than was described",
                   {{"sha256", ToHex(stored)}});
}

absl::Status CheckEtag(std::string_view asked, std::string_view stored) {
  if (asked.empty() || asked == stored) return absl::OkStatus();
  return MakeError(ErrorReason::kEtagMismatch,
                   "etag " + std::string(asked) + " is not the stored one, " +
                       std::string(stored),
                   {{"etag", std::string(stored)}});
}

absl::Status CheckStoredValues(
    const std::vector<MetadataKey>& keys, std::string_view shape,
    const std::map<std::string, std::string>& metadata) {
  absl::Status typed = CheckDeclaredValues(keys, metadata);
  if (typed.ok()) return typed;
  const std::string name(shape);
  return MakeError(
      ErrorReason::kFieldInvalid,
      "metadata_keys: of shape " + name + ", " + std::string(typed.message()),
      {{"field", "metadata_keys"}, {"shape", name}});
}

}  // namespace argmesh
