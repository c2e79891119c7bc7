#include "client/picture/surface_shader.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "client/picture/corner_normals.h"

namespace argmesh {
namespace {

using Eigen::Vector3f;

constexpr float kAmbient = 0.50F;
constexpr float kKey = 0.52F;
constexpr float kFill = 0.16F;
constexpr float kCircleHalfWidth = 0.9F;  // pixels

Vector3f ToVector(RgbColor color) {
  return Vector3f(color[0], color[1], color[2]);
}

}  // namespace

SurfaceShader::SurfaceShader(const TriangleMesh& mesh,
                             std::span<const RgbColor> face_colors,
                             const RayScene& scene, const View& view,
                             const RenderOptions& options)
    : face_colors_(face_colors),
      corner_normals_(ComputeCornerNormals(mesh, options.crease_degrees)),
      dot_pixels_(static_cast<float>(options.dot_pixels)) {
  for (Vector3f& normal : corner_normals_) {
    if (normal.isZero()) continue;
    normal = scene.DirectionToPicture(normal.cast<double>());
  }
  seen_from_behind_.reserve(static_cast<size_t>(mesh.num_faces()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d a = mesh.vertex(mesh.F(f, 0));
    const Eigen::Vector3d cross =
        (mesh.vertex(mesh.F(f, 1)) - a).cross(mesh.vertex(mesh.F(f, 2)) - a);
    seen_from_behind_.push_back(cross.dot(view.toward) < 0 ? 1 : 0);
  }
  for (const SurfaceMarker& marker : options.markers) {
    markers_.push_back(
        {.center = scene.ToPicture(marker.position),
         .window = static_cast<float>(marker.window * view.pixels_per_unit),
         .dot = ToVector(marker.dot),
         .circle = ToVector(marker.circle)});
  }
}

Vector3f SurfaceShader::Normal(const RayHit& hit) const {
  const auto corner = static_cast<size_t>(hit.face) * 3;
  Vector3f normal = (1 - hit.u - hit.v) * corner_normals_[corner] +
                    hit.u * corner_normals_[corner + 1] +
                    hit.v * corner_normals_[corner + 2];
  const float length = normal.norm();
  if (length < 1e-6F) return Vector3f::UnitZ();
  normal /= length;
  // The face, not the smooth normal, tells which side is seen: near the
  // outline the smooth one may already lean away.
  if (seen_from_behind_[static_cast<size_t>(hit.face)] != 0) normal = -normal;
  normal.z() = std::max(normal.z(), 0.02F);
  return normal.normalized();
}

Vector3f SurfaceShader::Color(const RayHit& hit, const Vector3f& at,
                              float openness) const {
  static const Vector3f key = Vector3f(-0.45F, -0.62F, 0.64F).normalized();
  static const Vector3f fill = Vector3f(0.75F, 0.10F, 0.65F).normalized();
  const Vector3f normal = Normal(hit);
  const float shade = 0.35F + 0.65F * openness;
  const float light = kAmbient * openness +
                      kKey * std::max(normal.dot(key), 0.0F) * shade +
                      kFill * std::max(normal.dot(fill), 0.0F) * shade;
  const Vector3f base =
      Mark(ToVector(face_colors_[static_cast<size_t>(hit.face)]), at, normal);
  return (base * light).cwiseMin(255.0F);
}

Vector3f SurfaceShader::Mark(Vector3f color, const Vector3f& at,
                             const Vector3f& normal) const {
  for (const Marker& marker : markers_) {
    const Vector3f away = at - marker.center;
    const float distance = away.norm();
    if (marker.window <= 0 || distance <= 0) continue;
    // Where the surface runs along the sphere the distance changes slowly: a
    // line of even width asks for less of it.
    const float cosine = normal.dot(away) / distance;
    const float slope = std::sqrt(std::max(1 - cosine * cosine, 0.0F));
    if (std::abs(distance - marker.window) < kCircleHalfWidth * slope) {
      color = marker.circle;
    }
  }
  for (const Marker& marker : markers_) {
    if ((at - marker.center).norm() < dot_pixels_) color = marker.dot;
  }
  return color;
}

}  // namespace argmesh
