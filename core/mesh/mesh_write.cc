#include "core/mesh/mesh_write.h"

#include <Eigen/Geometry>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/byte_writer.h"
#include "core/base/status_macros.h"
#include "core/mesh/text_scanner.h"

namespace argmesh {
namespace {

// Longer than the shortest text of any double or int32.
constexpr size_t kMaxNumberBytes = 32;

template <typename T>
void AppendNumber(std::string& text, T value, char after) {
  std::array<char, kMaxNumberBytes> digits;
  const auto result =
      std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), result.ptr);
  text.push_back(after);
}

// `before` begins each line of a vertex or face.
void AppendVertices(std::string& text, const TriangleMesh& mesh,
                    std::string_view before) {
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    text.append(before);
    for (int axis = 0; axis < 3; ++axis) {
      AppendNumber(text, mesh.V(v, axis), axis < 2 ? ' ' : '\n');
    }
  }
}

void AppendFaces(std::string& text, const TriangleMesh& mesh,
                 std::string_view before, int32_t first_index) {
  for (int f = 0; f < mesh.num_faces(); ++f) {
    text.append(before);
    for (int corner = 0; corner < 3; ++corner) {
      AppendNumber(text, mesh.F(f, corner) + first_index,
                   corner < 2 ? ' ' : '\n');
    }
  }
}

std::string SerializeOff(const TriangleMesh& mesh) {
  std::string text =
      absl::StrFormat("OFF\n%d %d 0\n", mesh.num_vertices(), mesh.num_faces());
  AppendVertices(text, mesh, "");
  AppendFaces(text, mesh, "3 ", 0);
  return text;
}

std::string SerializeObj(const TriangleMesh& mesh) {
  std::string text;
  AppendVertices(text, mesh, "v ");
  AppendFaces(text, mesh, "f ", 1);
  return text;
}

std::string SerializePly(const TriangleMesh& mesh,
                         std::span<const RgbColor> face_colors) {
  ByteWriter writer;
  writer.WriteBytes(absl::StrFormat(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex %d\nproperty double x\nproperty double y\n"
      "property double z\nelement face %d\n"
      "property list uchar int vertex_indices\n%send_header\n",
      mesh.num_vertices(), mesh.num_faces(),
      face_colors.empty() ? ""
                          : "property uchar red\nproperty uchar green\n"
                            "property uchar blue\n"));
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    for (int axis = 0; axis < 3; ++axis) writer.WriteF64(mesh.V(v, axis));
  }
  for (int f = 0; f < mesh.num_faces(); ++f) {
    writer.WriteU8(3);
    for (int corner = 0; corner < 3; ++corner) {
      writer.WriteU32(static_cast<uint32_t>(mesh.F(f, corner)));
    }
    if (face_colors.empty()) continue;
    for (const uint8_t channel : face_colors[static_cast<size_t>(f)]) {
      writer.WriteU8(channel);
    }
  }
  return writer.TakeBytes();
}

void WriteStlVector(ByteWriter& writer, const Eigen::Vector3d& vector) {
  for (const double value : vector) writer.WriteF32(static_cast<float>(value));
}

std::string SerializeStl(const TriangleMesh& mesh) {
  constexpr size_t kHeaderBytes = 80;
  std::string header = "binary STL, little-endian";
  header.resize(kHeaderBytes, ' ');
  ByteWriter writer;
  writer.WriteBytes(header);
  writer.WriteU32(static_cast<uint32_t>(mesh.num_faces()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d a = mesh.vertex(mesh.F(f, 0));
    const Eigen::Vector3d b = mesh.vertex(mesh.F(f, 1));
    const Eigen::Vector3d c = mesh.vertex(mesh.F(f, 2));
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double length = normal.norm();
    const bool has_normal = length > 0 && std::isfinite(length);
    WriteStlVector(writer, has_normal ? Eigen::Vector3d(normal / length)
                                      : Eigen::Vector3d::Zero());
    for (const Eigen::Vector3d& corner : {a, b, c}) {
      WriteStlVector(writer, corner);
    }
    writer.WriteU16(0);
  }
  return writer.TakeBytes();
}

absl::Status CheckWritable(const TriangleMesh& mesh) {
  ARGMESH_RETURN_IF_ERROR(CheckMesh(mesh));
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      if (IsCoordinate(mesh.V(v, axis))) continue;
      return absl::InvalidArgumentError(absl::StrFormat(
          "vertex %d: coordinate %g is beyond the range of float", v,
          mesh.V(v, axis)));
    }
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::string> SerializeMesh(const TriangleMesh& mesh,
                                          MeshFormat format) {
  ARGMESH_RETURN_IF_ERROR(CheckWritable(mesh));
  switch (format) {
    case MeshFormat::kOff:
      return SerializeOff(mesh);
    case MeshFormat::kObj:
      return SerializeObj(mesh);
    case MeshFormat::kPly:
      return SerializePly(mesh, {});
    case MeshFormat::kStl:
      return SerializeStl(mesh);
    case MeshFormat::kUnknown:
      break;
  }
  return absl::InvalidArgumentError("no format to write the mesh in");
}

std::string SerializeColoredPly(const TriangleMesh& mesh,
                                std::span<const RgbColor> face_colors) {
  return SerializePly(mesh, face_colors);
}

}  // namespace argmesh
