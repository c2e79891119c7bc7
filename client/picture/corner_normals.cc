#include "client/picture/corner_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>

namespace argmesh {
namespace {

using Eigen::Vector3d;

constexpr size_t kMaxFan = 64;

// Corners (3 * face + k) sorted by the position of their vertex.
std::vector<int32_t> CornersByPosition(const TriangleMesh& mesh) {
  std::vector<int32_t> corners(static_cast<size_t>(mesh.num_faces()) * 3);
  std::iota(corners.begin(), corners.end(), 0);
  const auto vertex = [&mesh](int32_t corner) {
    return mesh.V.row(mesh.F(corner / 3, corner % 3));
  };
  std::sort(corners.begin(), corners.end(), [&](int32_t a, int32_t b) {
    const auto p = vertex(a);
    const auto q = vertex(b);
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] != q[axis]) return p[axis] < q[axis];
    }
    return a < b;
  });
  return corners;
}

struct FaceFrame {
  Vector3d normal = Vector3d::Zero();
  double angles[3] = {0, 0, 0};
};

FaceFrame MakeFaceFrame(const TriangleMesh& mesh, int f) {
  FaceFrame frame;
  Vector3d p[3];
  for (int k = 0; k < 3; ++k) p[k] = mesh.vertex(mesh.F(f, k));
  const Vector3d cross = (p[1] - p[0]).cross(p[2] - p[0]);
  if (!(cross.norm() > 0)) return frame;
  frame.normal = cross.normalized();
  for (int k = 0; k < 3; ++k) {
    const Vector3d u = (p[(k + 1) % 3] - p[k]).normalized();
    const Vector3d v = (p[(k + 2) % 3] - p[k]).normalized();
    frame.angles[k] = std::acos(std::clamp(u.dot(v), -1.0, 1.0));
  }
  return frame;
}

void SmoothFan(std::span<const int32_t> fan,
               const std::vector<FaceFrame>& frames, double min_cosine,
               std::vector<Eigen::Vector3f>& normals) {
  for (const int32_t corner : fan) {
    const Vector3d own = frames[static_cast<size_t>(corner / 3)].normal;
    Vector3d sum = Vector3d::Zero();
    for (const int32_t other : fan) {
      const FaceFrame& frame = frames[static_cast<size_t>(other / 3)];
      if (frame.normal.dot(own) < min_cosine) continue;
      sum += frame.normal * frame.angles[other % 3];
      if (fan.size() > kMaxFan) break;
    }
    if (fan.size() > kMaxFan || sum.norm() < 1e-12) sum = own;
    if (sum.norm() > 0) sum.normalize();
    normals[static_cast<size_t>(corner)] = sum.cast<float>();
  }
}

}  // namespace

std::vector<Eigen::Vector3f> ComputeCornerNormals(const TriangleMesh& mesh,
                                                  double crease_degrees) {
  std::vector<FaceFrame> frames;
  frames.reserve(static_cast<size_t>(mesh.num_faces()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    frames.push_back(MakeFaceFrame(mesh, f));
  }
  const double min_cosine = std::cos(crease_degrees * std::numbers::pi / 180);
  const std::vector<int32_t> corners = CornersByPosition(mesh);
  std::vector<Eigen::Vector3f> normals(corners.size(), Eigen::Vector3f::Zero());
  const auto position = [&mesh](int32_t corner) {
    return mesh.V.row(mesh.F(corner / 3, corner % 3));
  };
  for (size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    while (end < corners.size() &&
           position(corners[end]) == position(corners[begin])) {
      ++end;
    }
    SmoothFan(std::span(corners).subspan(begin, end - begin), frames,
              min_cosine, normals);
  }
  return normals;
}

}  // namespace argmesh
