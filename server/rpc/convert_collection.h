// argmesh/v1/collection.proto to and from the engine's types.
#ifndef ARGMESH_SERVER_RPC_CONVERT_COLLECTION_H_
#define ARGMESH_SERVER_RPC_CONVERT_COLLECTION_H_

#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "argmesh/v1/collection.pb.h"
#include "server/engine/collection_record.h"

namespace argmesh {

// What is not set is that of `unset`. FIELD_INVALID with a field below `field`.
absl::StatusOr<CollectionSettings> FromProto(
    std::string_view field, const v1::CollectionSettings& settings,
    const CollectionSettings& unset = {});

// FIELD_INVALID for a type that is none.
absl::StatusOr<std::vector<MetadataKey>> FromProto(
    std::string_view field,
    const google::protobuf::RepeatedPtrField<v1::MetadataKey>& keys);

v1::CollectionSettings ToProto(const CollectionSettings& settings);
v1::Collection ToProto(const CollectionRecord& record);

v1::DecompositionKind ToProto(DecompositionKind kind);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_COLLECTION_H_
