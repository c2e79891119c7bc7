// A mesh prepared for casting rays from its surface and its inside.
//
// Repeats  equal input gives bit-equal output; everything runs on the calling
//          thread.
// Cost     O(m log m) to create, O(log m) a ray. Rays are thread-safe.
#ifndef ARGMESH_CORE_GEOMETRY_RAY_SCENE_H_
#define ARGMESH_CORE_GEOMETRY_RAY_SCENE_H_

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "absl/status/statusor.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

class RayScene {
 public:
  // Positions are rounded to floats.
  //
  // Fails    kInternal  the ray tracer could not be set up
  static absl::StatusOr<RayScene> Create(const TriangleMesh& mesh);

  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  ~RayScene();

  // Distance >= `min_distance` along the unit `direction` to the first face
  // that the ray leaves through: one whose outward normal it does not oppose.
  // Faces it enters through are passed.
  std::optional<float> FindExit(const Eigen::Vector3f& origin,
                                const Eigen::Vector3f& direction,
                                float min_distance) const;

  // Whether a ray from `origin` along `direction` meets any face, from
  // whichever side.
  bool IsOccluded(const Eigen::Vector3f& origin,
                  const Eigen::Vector3f& direction) const;

 private:
  struct Scene;
  explicit RayScene(std::unique_ptr<Scene> scene);

  std::unique_ptr<Scene> scene_;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_RAY_SCENE_H_
