// argmesh/v1/mesh.proto to and from the engine's types.
#ifndef ARGMESH_SERVER_RPC_CONVERT_MESH_H_
#define ARGMESH_SERVER_RPC_CONVERT_MESH_H_

#include <array>
#include <optional>
#include <string_view>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "argmesh/v1/mesh.pb.h"
#include "core/base/sha256.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_report.h"
#include "google/protobuf/duration.pb.h"
#include "google/protobuf/timestamp.pb.h"

namespace argmesh {

// FIELD_INVALID for a number that is no format.
absl::StatusOr<MeshFormat> FromProto(std::string_view field,
                                     v1::MeshFormat format);
v1::MeshFormat ToProto(MeshFormat format);

v1::MeshReport ToProto(const MeshReport& report);

v1::Vector3 ToVector(const double (&point)[3]);
v1::Vector3 ToVector(const std::array<float, 3>& point);
v1::Vector3 ToVector(const std::array<double, 3>& point);

// 64 hexadecimal digits of either case. FIELD_REQUIRED, FIELD_INVALID.
absl::StatusOr<Sha256Digest> ParseSha256(std::string_view field,
                                         std::string_view hex);

google::protobuf::Timestamp ToTimestamp(absl::Time time);
google::protobuf::Duration ToDuration(absl::Duration duration);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_MESH_H_
