#include "core/signature/surface_points.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/random.h"

namespace argmesh {
namespace {

constexpr uint64_t kSeed = 1;

}  // namespace

SurfacePoints SpreadPoints(const SignatureSurface& surface) {
  const TriangleMesh& mesh = surface.mesh;
  Random random(kSeed);
  SurfacePoints points;
  points.positions.reserve(kSurfacePoints);
  points.normals.reserve(kSurfacePoints);
  const double step = surface.face_areas.sum() / kSurfacePoints;
  double passed = surface.face_areas[0];
  int f = 0;
  for (int i = 0; i < kSurfacePoints; ++i) {
    const double at = step * (i + random.Uniform());
    while (passed < at && f + 1 < mesh.num_faces()) {
      passed += surface.face_areas[++f];
    }
    const double u = std::sqrt(random.Uniform());
    const double v = random.Uniform();
    const Eigen::Vector3d point = (1 - u) * mesh.vertex(mesh.F(f, 0)) +
                                  u * (1 - v) * mesh.vertex(mesh.F(f, 1)) +
                                  u * v * mesh.vertex(mesh.F(f, 2));
    points.positions.push_back(point.cast<float>());
    points.normals.push_back(
        surface.face_normals.row(f).transpose().cast<float>());
  }
  for (size_t i = points.positions.size(); i > 1; --i) {
    const auto j = static_cast<size_t>(random.Below(i));
    std::swap(points.positions[i - 1], points.positions[j]);
    std::swap(points.normals[i - 1], points.normals[j]);
  }
  return points;
}

}  // namespace argmesh
