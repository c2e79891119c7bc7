#include "core/mesh/mesh_ply.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_assembly.h"
#include "core/mesh/mesh_ply_body.h"
#include "core/mesh/mesh_ply_header.h"

namespace argmesh {
namespace {

enum class PlyRole { kSkipped, kX, kY, kZ, kCorners };
enum class PlyKind { kOther, kVertex, kFace, kStrip };

constexpr int64_t kRestart = -1;

PlyKind KindOf(const PlyElement& element) {
  if (element.name == "vertex") return PlyKind::kVertex;
  if (element.name == "face") return PlyKind::kFace;
  if (element.name == "tristrips") return PlyKind::kStrip;
  return PlyKind::kOther;
}

PlyRole RoleOf(PlyKind kind, const PlyProperty& property) {
  if (kind == PlyKind::kVertex && !property.count_type) {
    if (property.name == "x") return PlyRole::kX;
    if (property.name == "y") return PlyRole::kY;
    if (property.name == "z") return PlyRole::kZ;
  }
  const bool has_corners = kind == PlyKind::kFace || kind == PlyKind::kStrip;
  if (has_corners && property.count_type && IsPlyInteger(property.type) &&
      (property.name == "vertex_indices" || property.name == "vertex_index")) {
    return PlyRole::kCorners;
  }
  return PlyRole::kSkipped;
}

std::vector<PlyRole> RolesOf(PlyKind kind, const PlyElement& element) {
  std::vector<PlyRole> roles;
  for (const PlyProperty& property : element.properties) {
    roles.push_back(RoleOf(kind, property));
  }
  return roles;
}

template <typename Source>
class PlyReader {
 public:
  PlyReader(Source source, const PlyHeader& header, const MeshLimits& limits,
            size_t file_bytes)
      : source_(std::move(source)),
        header_(header),
        assembly_(limits, file_bytes) {}

  absl::StatusOr<ParsedMesh> Read() &&;

 private:
  absl::Status CheckElement(const PlyElement& element, PlyKind kind);
  absl::Status CheckRoles(const PlyElement& element, PlyKind kind,
                          const std::vector<PlyRole>& roles);
  absl::Status ReadElement(const PlyElement& element);
  absl::Status ReadItem(const PlyElement& element, PlyKind kind,
                        const std::vector<PlyRole>& roles);
  absl::Status ReadScalar(const PlyProperty& property, PlyRole role);
  absl::Status ReadList(const PlyProperty& property, PlyKind kind,
                        PlyRole role);
  absl::Status AddItem(PlyKind kind);
  absl::Status AddStrips();

  Source source_;
  const PlyHeader& header_;
  MeshAssembly assembly_;
  int64_t declared_vertices_ = 0;
  // Of the item at hand.
  int64_t item_ = 0;
  std::array<double, 3> position_ = {0, 0, 0};
  std::vector<int32_t> corners_;
};

template <typename Source>
absl::Status PlyReader<Source>::CheckElement(const PlyElement& element,
                                             PlyKind kind) {
  if (element.count == 0) return absl::OkStatus();
  if (kind == PlyKind::kFace) {
    ARGMESH_RETURN_IF_ERROR(
        source_.Located(assembly_.CheckFaceCount(element.count)));
  }
  int64_t item_bytes = 0;
  for (const PlyProperty& property : element.properties) {
    item_bytes += source_.MinBytes(property.count_type.value_or(property.type));
  }
  if (item_bytes == 0) {
    return source_.Malformed(
        absl::StrFormat("element %s: %d items without properties",
                        std::string(element.name), element.count));
  }
  if (element.count > source_.BytesLeft() / item_bytes) {
    return source_.Malformed(absl::StrFormat(
        "element %s: %d items take at least %d bytes each, %d are left",
        std::string(element.name), element.count, item_bytes,
        source_.BytesLeft()));
  }
  return absl::OkStatus();
}

template <typename Source>
absl::Status PlyReader<Source>::CheckRoles(const PlyElement& element,
                                           PlyKind kind,
                                           const std::vector<PlyRole>& roles) {
  const auto check = [&](PlyRole role, const char* name) {
    const auto times = std::count(roles.begin(), roles.end(), role);
    if (times == 1) return absl::OkStatus();
    return source_.Malformed(
        absl::StrFormat("element %s has %d properties %s, not one",
                        std::string(element.name), times, name));
  };
  if (kind == PlyKind::kVertex) {
    ARGMESH_RETURN_IF_ERROR(check(PlyRole::kX, "x"));
    ARGMESH_RETURN_IF_ERROR(check(PlyRole::kY, "y"));
    return check(PlyRole::kZ, "z");
  }
  if (kind == PlyKind::kOther) return absl::OkStatus();
  return check(PlyRole::kCorners, "vertex_indices");
}

template <typename Source>
absl::Status PlyReader<Source>::ReadList(const PlyProperty& property,
                                         PlyKind kind, PlyRole role) {
  ARGMESH_ASSIGN_OR_RETURN(const int64_t size,
                           source_.ReadInteger(*property.count_type));
  if (size < 0 ||
      size > source_.BytesLeft() / source_.MinBytes(property.type)) {
    return source_.Malformed(
        absl::StrFormat("item %d: a list of %d values, %d bytes are left",
                        item_, size, source_.BytesLeft()));
  }
  if (role != PlyRole::kCorners) return source_.Skip(property.type, size);
  if (kind == PlyKind::kFace) {
    ARGMESH_RETURN_IF_ERROR(source_.Located(assembly_.CheckValence(size)));
  }
  corners_.reserve(static_cast<size_t>(size));
  for (int64_t i = 0; i < size; ++i) {
    ARGMESH_ASSIGN_OR_RETURN(const int64_t vertex,
                             source_.ReadInteger(property.type));
    const bool restarts = kind == PlyKind::kStrip && vertex == kRestart;
    if (!restarts && (vertex < 0 || vertex >= declared_vertices_)) {
      return source_.Malformed(absl::StrFormat(
          "face %d: vertex %d of %d", item_, vertex, declared_vertices_));
    }
    corners_.push_back(static_cast<int32_t>(vertex));
  }
  return absl::OkStatus();
}

template <typename Source>
absl::Status PlyReader<Source>::ReadScalar(const PlyProperty& property,
                                           PlyRole role) {
  if (role == PlyRole::kSkipped) return source_.Skip(property.type, 1);
  const size_t axis = role == PlyRole::kX ? 0 : role == PlyRole::kY ? 1 : 2;
  ARGMESH_ASSIGN_OR_RETURN(position_[axis],
                           source_.ReadCoordinate(property.type));
  return absl::OkStatus();
}

template <typename Source>
absl::Status PlyReader<Source>::ReadItem(const PlyElement& element,
                                         PlyKind kind,
                                         const std::vector<PlyRole>& roles) {
  corners_.clear();
  for (size_t i = 0; i < roles.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    ARGMESH_RETURN_IF_ERROR(property.count_type
                                ? ReadList(property, kind, roles[i])
                                : ReadScalar(property, roles[i]));
  }
  ARGMESH_RETURN_IF_ERROR(source_.Located(AddItem(kind)));
  return source_.EndItem();
}

template <typename Source>
absl::Status PlyReader<Source>::AddStrips() {
  auto begin = corners_.begin();
  while (true) {
    const auto end = std::find(begin, corners_.end(), kRestart);
    ARGMESH_RETURN_IF_ERROR(assembly_.AddStrip({begin, end}));
    if (end == corners_.end()) return absl::OkStatus();
    begin = end + 1;
  }
}

template <typename Source>
absl::Status PlyReader<Source>::AddItem(PlyKind kind) {
  switch (kind) {
    case PlyKind::kVertex:
      return assembly_.AddVertex(position_[0], position_[1], position_[2]);
    case PlyKind::kFace:
      return assembly_.AddPolygon(corners_);
    case PlyKind::kStrip:
      return AddStrips();
    case PlyKind::kOther:
      break;
  }
  return absl::OkStatus();
}

template <typename Source>
absl::Status PlyReader<Source>::ReadElement(const PlyElement& element) {
  const PlyKind kind = KindOf(element);
  ARGMESH_RETURN_IF_ERROR(CheckElement(element, kind));
  if (element.count == 0) return absl::OkStatus();
  const std::vector<PlyRole> roles = RolesOf(kind, element);
  ARGMESH_RETURN_IF_ERROR(CheckRoles(element, kind, roles));
  if (kind == PlyKind::kVertex) assembly_.ReserveVertices(element.count);
  if (kind == PlyKind::kOther) assembly_.CountIgnoredStatements(1);
  for (item_ = 0; item_ < element.count; ++item_) {
    ARGMESH_RETURN_IF_ERROR(ReadItem(element, kind, roles));
  }
  return absl::OkStatus();
}

template <typename Source>
absl::StatusOr<ParsedMesh> PlyReader<Source>::Read() && {
  const PlyElement* vertices = header_.FindElement("vertex");
  if (vertices == nullptr) return source_.Malformed("no element vertex");
  ARGMESH_RETURN_IF_ERROR(
      source_.Located(assembly_.CheckVertexCount(vertices->count)));
  declared_vertices_ = vertices->count;
  for (const PlyElement& element : header_.elements) {
    ARGMESH_RETURN_IF_ERROR(ReadElement(element));
  }
  ARGMESH_RETURN_IF_ERROR(source_.ExpectEnd());
  assembly_.CountIgnoredStatements(source_.lines_with_more());
  absl::StatusOr<ParsedMesh> parsed =
      std::move(assembly_).Finish(MeshFormat::kPly);
  if (!parsed.ok()) return source_.Located(parsed.status());
  return parsed;
}

}  // namespace

absl::StatusOr<ParsedMesh> ParsePly(std::string_view bytes,
                                    const MeshLimits& limits) {
  ARGMESH_ASSIGN_OR_RETURN(const PlyHeader header,
                           ParsePlyHeader(bytes, limits));
  if (header.encoding == PlyEncoding::kAscii) {
    return PlyReader(PlyTextSource(bytes, header, limits), header, limits,
                     bytes.size())
        .Read();
  }
  return PlyReader(PlyBinarySource(bytes, header), header, limits, bytes.size())
      .Read();
}

}  // namespace argmesh
