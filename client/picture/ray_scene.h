// A mesh that rays can be shot at, seen by an orthographic camera: lengths are
// in pixels of the picture, x to the right, y down, z toward the eye.
//
// Fails    kResourceExhausted  the ray tracer refuses the mesh
// Cost     O(m log m) to make, O(log m) a ray. Const calls are thread-safe.
#ifndef ARGMESH_CLIENT_PICTURE_RAY_SCENE_H_
#define ARGMESH_CLIENT_PICTURE_RAY_SCENE_H_

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "absl/status/statusor.h"
#include "client/picture/view.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct RayHit {
  int32_t face = -1;  // -1: nothing was hit
  float z = 0;        // of the point hit; larger is nearer to the eye
  float u = 0;        // barycentric, of the face's second and third corner
  float v = 0;
};

class RayScene {
 public:
  static absl::StatusOr<RayScene> Create(const TriangleMesh& mesh,
                                         const View& view, int width,
                                         int height);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  // Along the view, through the point (x, y) of the picture.
  RayHit Look(float x, float y) const;
  // Whether the mesh is met within `reach` pixels.
  bool Occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                float reach) const;

  // From the mesh's coordinates to the picture's.
  Eigen::Vector3f ToPicture(const Eigen::Vector3d& p) const;
  Eigen::Vector3f DirectionToPicture(const Eigen::Vector3d& d) const;

 private:
  struct Impl;
  explicit RayScene(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_RAY_SCENE_H_
