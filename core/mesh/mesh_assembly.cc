#include "core/mesh/mesh_assembly.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/polygon_triangulation.h"

namespace argmesh {
namespace {

constexpr int64_t kMaxIndex = std::numeric_limits<int32_t>::max();

// Point-in-triangle tests, a few nanoseconds each: one polygon of the default
// valence limit with every second corner reflex takes about 10^8.
constexpr int64_t kFreeTests = 200'000'000;
constexpr int64_t kTestsPerByte = 32;

absl::Status CheckAtMost(int64_t value, int64_t limit, const char* thing) {
  if (value <= limit) return absl::OkStatus();
  return absl::ResourceExhaustedError(
      absl::StrFormat("%d %s, at most %d", value, thing, limit));
}

// Odd triangles of a strip are turned round.
std::array<int32_t, 3> StripTriangle(std::span<const int32_t> strip, size_t i) {
  const size_t odd = i % 2;
  return {strip[i + odd], strip[i + 1 - odd], strip[i + 2]};
}

}  // namespace

MeshAssembly::MeshAssembly(const MeshLimits& limits, size_t file_bytes)
    : limits_(limits),
      max_tests_(kFreeTests +
                 kTestsPerByte * static_cast<int64_t>(file_bytes)) {
  limits_.max_vertices = std::min(limits_.max_vertices, kMaxIndex);
  // Three corners of each are counted in 32 bits by what comes after.
  limits_.max_faces = std::min(limits_.max_faces, kMaxIndex / 3);
  limits_.max_polygon_vertices =
      std::min(limits_.max_polygon_vertices, kMaxIndex);
}

absl::Status MeshAssembly::CheckVertexCount(int64_t count) const {
  return CheckAtMost(count, limits_.max_vertices, "vertices");
}

absl::Status MeshAssembly::CheckFaceCount(int64_t count) const {
  return CheckAtMost(count, limits_.max_faces, "faces");
}

absl::Status MeshAssembly::CheckValence(int64_t valence) const {
  return CheckAtMost(valence, limits_.max_polygon_vertices,
                     "vertices in one face");
}

void MeshAssembly::ReserveVertices(int64_t count) {
  coordinates_.reserve(3 * static_cast<size_t>(count));
}

absl::Status MeshAssembly::AddVertex(double x, double y, double z) {
  ARGMESH_RETURN_IF_ERROR(CheckVertexCount(num_vertices() + 1));
  coordinates_.insert(coordinates_.end(), {x, y, z});
  return absl::OkStatus();
}

absl::Status MeshAssembly::AddTriangles(int64_t count) {
  num_triangles_ += count;
  return CheckAtMost(num_triangles_, limits_.max_faces, "triangles");
}

absl::Status MeshAssembly::AddPolygon(std::span<const int32_t> corners) {
  const auto valence = static_cast<int64_t>(corners.size());
  ARGMESH_RETURN_IF_ERROR(CheckValence(valence));
  ARGMESH_RETURN_IF_ERROR(CheckFaceCount(++num_file_faces_));
  if (valence < 3) {
    ++skipped_file_faces_;
    valences_.push_back(0);
    return absl::OkStatus();
  }
  valences_.push_back(static_cast<int32_t>(valence));
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  return AddTriangles(valence - 2);
}

absl::Status MeshAssembly::AddStrip(std::span<const int32_t> corners) {
  const auto valence = static_cast<int64_t>(corners.size());
  if (valence < 3) return absl::OkStatus();
  num_file_faces_ += valence - 2;
  ARGMESH_RETURN_IF_ERROR(CheckFaceCount(num_file_faces_));
  valences_.push_back(static_cast<int32_t>(-valence));
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  return AddTriangles(valence - 2);
}

absl::Status MeshAssembly::FillFaces(ParsedMesh& parsed) {
  PolygonTriangulator triangulator(coordinates_, max_tests_);
  std::span<const int32_t> rest = corners_;
  std::span<int32_t> triangles(parsed.mesh.F.data(),
                               static_cast<size_t>(parsed.mesh.F.size()));
  int32_t file_face = 0;
  for (const int32_t valence : valences_) {
    const auto size = static_cast<size_t>(valence < 0 ? -valence : valence);
    const std::span<const int32_t> corners = rest.first(size);
    rest = rest.subspan(size);
    if (valence == 0) ++file_face;
    if (valence == 0) continue;
    const size_t count = size - 2;
    if (valence < 0) {
      for (size_t i = 0; i < count; ++i) {
        const std::array<int32_t, 3> triangle = StripTriangle(corners, i);
        std::copy(triangle.begin(), triangle.end(),
                  triangles.subspan(3 * i).begin());
        parsed.file_face.push_back(file_face++);
      }
    } else {
      const absl::Status status = triangulator.Triangulate(corners, triangles);
      if (!status.ok()) {
        return absl::Status(status.code(),
                            absl::StrFormat("face %d: %s", file_face,
                                            std::string(status.message())));
      }
      parsed.file_face.insert(parsed.file_face.end(), count, file_face++);
    }
    triangles = triangles.subspan(3 * count);
  }
  parsed.irregular_file_faces = triangulator.num_irregular();
  return absl::OkStatus();
}

absl::StatusOr<ParsedMesh> MeshAssembly::Finish(MeshFormat format) && {
  if (num_triangles_ == 0) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "no faces: %d vertices and %d faces of fewer than 3 vertices",
        num_vertices(), skipped_file_faces_));
  }
  ParsedMesh parsed;
  parsed.format = format;
  parsed.num_file_faces = static_cast<int32_t>(num_file_faces_);
  parsed.skipped_file_faces = skipped_file_faces_;
  parsed.ignored_statements = ignored_statements_;
  parsed.mesh.F.resize(num_triangles_, 3);
  parsed.file_face.reserve(static_cast<size_t>(num_triangles_));
  ARGMESH_RETURN_IF_ERROR(FillFaces(parsed));
  corners_ = {};
  valences_ = {};
  parsed.mesh.V =
      Eigen::Map<const VertexMatrix>(coordinates_.data(), num_vertices(), 3);
  return parsed;
}

}  // namespace argmesh
