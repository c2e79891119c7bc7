#include "server/rpc/convert_mesh.h"

#include <string>

#include "absl/strings/str_format.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

int HexValue(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return -1;
}

v1::Vector3 MakeVector(double x, double y, double z) {
  v1::Vector3 out;
  out.set_x(x);
  out.set_y(y);
  out.set_z(z);
  return out;
}

}  // namespace

absl::StatusOr<MeshFormat> FromProto(std::string_view field,
                                     v1::MeshFormat format) {
  switch (format) {
    case v1::MESH_FORMAT_UNSPECIFIED:
      return MeshFormat::kUnknown;
    case v1::MESH_FORMAT_OFF:
      return MeshFormat::kOff;
    case v1::MESH_FORMAT_OBJ:
      return MeshFormat::kObj;
    case v1::MESH_FORMAT_PLY:
      return MeshFormat::kPly;
    case v1::MESH_FORMAT_STL:
      return MeshFormat::kStl;
    default:
      return FieldInvalid(field, absl::StrFormat("%d is no mesh format",
                                                 static_cast<int>(format)));
  }
}

v1::MeshFormat ToProto(MeshFormat format) {
  switch (format) {
    case MeshFormat::kUnknown:
      return v1::MESH_FORMAT_UNSPECIFIED;
    case MeshFormat::kOff:
      return v1::MESH_FORMAT_OFF;
    case MeshFormat::kObj:
      return v1::MESH_FORMAT_OBJ;
    case MeshFormat::kPly:
      return v1::MESH_FORMAT_PLY;
    case MeshFormat::kStl:
      return v1::MESH_FORMAT_STL;
  }
  return v1::MESH_FORMAT_UNSPECIFIED;
}

v1::MeshReport ToProto(const MeshReport& report) {
  v1::MeshReport out;
  out.set_vertices(report.vertices);
  out.set_faces(report.faces);
  out.set_components(report.components);
  out.set_boundary_edges(report.boundary_edges);
  out.set_nonmanifold_edges(report.nonmanifold_edges);
  out.set_nonmanifold_vertices(report.nonmanifold_vertices);
  out.set_unused_vertices(report.unused_vertices);
  out.set_area(report.area);
  *out.mutable_bounding_box_min() = ToVector(report.bounding_box_min);
  *out.mutable_bounding_box_max() = ToVector(report.bounding_box_max);
  out.set_euler_characteristic(report.euler_characteristic);
  out.set_welded_vertices(report.welded_vertices);
  out.set_degenerate_faces_dropped(report.degenerate_faces_dropped);
  out.set_duplicate_faces_dropped(report.duplicate_faces_dropped);
  out.set_faces_flipped(report.faces_flipped);
  out.set_vertices_split(report.vertices_split);
  out.set_sample_vertices(report.sample_vertices);
  out.set_smoothed(report.smoothed);
  return out;
}

v1::Vector3 ToVector(const double (&point)[3]) {
  return MakeVector(point[0], point[1], point[2]);
}

v1::Vector3 ToVector(const std::array<float, 3>& point) {
  return MakeVector(point[0], point[1], point[2]);
}

v1::Vector3 ToVector(const std::array<double, 3>& point) {
  return MakeVector(point[0], point[1], point[2]);
}

absl::StatusOr<Sha256Digest> ParseSha256(std::string_view field,
                                         std::string_view hex) {
  if (hex.empty()) return FieldRequired(field);
  Sha256Digest digest{};
  if (hex.size() != 2 * digest.size()) {
    return FieldInvalid(field, absl::StrFormat("%d characters instead of %d",
                                               hex.size(), 2 * digest.size()));
  }
  for (size_t i = 0; i < digest.size(); ++i) {
    const int high = HexValue(hex[2 * i]);
    const int low = HexValue(hex[2 * i + 1]);
    if (high < 0 || low < 0) {
      return FieldInvalid(
          field, absl::StrFormat("no hexadecimal digits at %d", 2 * i));
    }
    digest[i] = static_cast<uint8_t>(16 * high + low);
  }
  return digest;
}

google::protobuf::Timestamp ToTimestamp(absl::Time time) {
  google::protobuf::Timestamp out;
  const int64_t nanos = absl::ToUnixNanos(time);
  const int64_t seconds = absl::ToUnixSeconds(time);  // rounds down
  out.set_seconds(seconds);
  out.set_nanos(static_cast<int32_t>(nanos - seconds * 1'000'000'000));
  return out;
}

google::protobuf::Duration ToDuration(absl::Duration duration) {
  google::protobuf::Duration out;
  const int64_t nanos = absl::ToInt64Nanoseconds(duration);
  out.set_seconds(nanos / 1'000'000'000);
  out.set_nanos(static_cast<int32_t>(nanos % 1'000'000'000));
  return out;
}

}  // namespace argmesh
