// Names of resources: `collections/{c}` and `collections/{c}/shapes/{s}`.
//
// Fails    kInvalidArgument FIELD_REQUIRED  the name is empty
//          kInvalidArgument NAME_INVALID    any other that is none
//          both with metadata `field`
#ifndef ARGMESH_SERVER_RPC_RESOURCE_NAME_H_
#define ARGMESH_SERVER_RPC_RESOURCE_NAME_H_

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

// The collection's id.
absl::StatusOr<std::string> ParseCollectionName(std::string_view field,
                                                std::string_view name);
absl::StatusOr<ShapeRef> ParseShapeName(std::string_view field,
                                        std::string_view name);
// An id on its own.
absl::Status CheckResourceId(std::string_view field, std::string_view id);

// The snapshot's id, the operation's UUID.
absl::StatusOr<std::string> ParseSnapshotName(std::string_view field,
                                              std::string_view name);
absl::StatusOr<std::string> ParseOperationName(std::string_view field,
                                               std::string_view name);

std::string CollectionName(std::string_view collection);
std::string ShapeName(std::string_view collection, std::string_view shape);
std::string SnapshotName(std::string_view snapshot);
std::string OperationName(std::string_view operation);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_RESOURCE_NAME_H_
