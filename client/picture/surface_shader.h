// The light on a point of a rendered surface: everything RenderMesh knows
// between the rays and the pixels.
#ifndef ARGMESH_CLIENT_PICTURE_SURFACE_SHADER_H_
#define ARGMESH_CLIENT_PICTURE_SURFACE_SHADER_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "client/picture/ray_scene.h"
#include "client/picture/render.h"

namespace argmesh {

class SurfaceShader {
 public:
  // All arguments must outlive the shader.
  SurfaceShader(const TriangleMesh& mesh, std::span<const RgbColor> face_colors,
                const RayScene& scene, const View& view,
                const RenderOptions& options);

  // Turned toward the eye, in the picture's axes.
  Eigen::Vector3f Normal(const RayHit& hit) const;
  // 0 .. 255; `openness` is the share of the sky that is free.
  Eigen::Vector3f Color(const RayHit& hit, const Eigen::Vector3f& at,
                        float openness) const;

 private:
  struct Marker {
    Eigen::Vector3f center;  // in the picture
    float window = 0;        // pixels
    Eigen::Vector3f dot, circle;
  };
  Eigen::Vector3f Mark(Eigen::Vector3f color, const Eigen::Vector3f& at,
                       const Eigen::Vector3f& normal) const;

  std::span<const RgbColor> face_colors_;
  std::vector<Eigen::Vector3f> corner_normals_;  // in the picture's axes
  std::vector<uint8_t> seen_from_behind_;        // of each face
  std::vector<Marker> markers_;
  float dot_pixels_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_SURFACE_SHADER_H_
