// argmesh/v1/shape.proto to and from the engine's types.
#ifndef ARGMESH_SERVER_RPC_CONVERT_SHAPE_H_
#define ARGMESH_SERVER_RPC_CONVERT_SHAPE_H_

#include <string_view>

#include "absl/status/statusor.h"
#include "argmesh/v1/shape.pb.h"
#include "server/engine/shape_record.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

v1::Shape ToProto(const ShapeRecord& record);

// FIELD_INVALID for a number that is no policy.
absl::StatusOr<IfExists> FromProto(std::string_view field,
                                   v1::ExistingShapePolicy policy);

// What the owner says about a new shape; everything else of `shape` is the
// server's to set and ignored.
void CopyOwnerFields(const v1::Shape& shape, NewShape* out);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_SHAPE_H_
