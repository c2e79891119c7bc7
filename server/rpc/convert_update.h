// Updates as AIP-134 has them: a resource with new values, and a mask of the
// fields that change.
//
// Without a mask the fields that are set in the resource change; "*" changes
// all that may.
// Fails    kInvalidArgument FIELD_REQUIRED  the resource or its name is missing
//          kInvalidArgument NAME_INVALID    the name is none
//          kInvalidArgument FIELD_INVALID   the mask names a field that may not
//                                           change, or nothing would change
#ifndef ARGMESH_SERVER_RPC_CONVERT_UPDATE_H_
#define ARGMESH_SERVER_RPC_CONVERT_UPDATE_H_

#include "absl/status/statusor.h"
#include "argmesh/v1/collection_service.pb.h"
#include "argmesh/v1/shape_service.pb.h"
#include "server/engine/catalog_requests.h"

namespace argmesh {

// May change: display_name, metadata_keys (as a whole).
absl::StatusOr<CollectionPatch> FromProto(
    const v1::UpdateCollectionRequest& request);

// May change: display_name, source_uri, metadata (as a whole).
absl::StatusOr<ShapePatch> FromProto(const v1::UpdateShapeRequest& request);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_UPDATE_H_
