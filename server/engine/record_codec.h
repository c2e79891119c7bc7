// Records as bytes: what a catalog keeps of them in opaque columns and as the
// remembered answer of a request.
//
// Versioned and bounds-checked, not checksummed. Serialize then Parse gives
// the same record.
// Fails    kDataLoss  other bytes than Serialize made
#ifndef ARGMESH_SERVER_ENGINE_RECORD_CODEC_H_
#define ARGMESH_SERVER_ENGINE_RECORD_CODEC_H_

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "server/engine/catalog_requests.h"
#include "server/engine/collection_record.h"
#include "server/engine/shape_record.h"

namespace argmesh {

std::string SerializeCollectionSettings(const CollectionSettings& settings);
absl::StatusOr<CollectionSettings> ParseCollectionSettings(
    std::string_view bytes);

std::string SerializeMetadataKeys(const std::vector<MetadataKey>& keys);
absl::StatusOr<std::vector<MetadataKey>> ParseMetadataKeys(
    std::string_view bytes);

// MeshReport and GraphSummary of a shape: `record`'s other fields are left.
std::string SerializeShapeDetails(const ShapeRecord& record);
absl::Status ParseShapeDetails(std::string_view bytes, ShapeRecord& record);

std::string SerializeShapeRecord(const ShapeRecord& record);
absl::StatusOr<ShapeRecord> ParseShapeRecord(std::string_view bytes);

std::string SerializeCollectionRecord(const CollectionRecord& record);
absl::StatusOr<CollectionRecord> ParseCollectionRecord(std::string_view bytes);

// Remembered answers: without the meshes that became unreferenced, and a shape
// that is read was not written now.
std::string SerializeShapeWritten(const ShapeWritten& written);
absl::StatusOr<ShapeWritten> ParseShapeWritten(std::string_view bytes);
std::string SerializeShapeDeleted(const ShapeDeleted& deleted);
absl::StatusOr<ShapeDeleted> ParseShapeDeleted(std::string_view bytes);
std::string SerializeCollectionDeleted(const CollectionDeleted& deleted);
absl::StatusOr<CollectionDeleted> ParseCollectionDeleted(
    std::string_view bytes);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_RECORD_CODEC_H_
