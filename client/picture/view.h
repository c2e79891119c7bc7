// From where a shape is looked at: an orthographic camera that fits it.
//
// With `up` given the shape stands on it and is turned about it; without, the
// principal axes of its area decide: the longest lies left to right, the
// second stands up, signs by the third moment.
// Repeats  equal input gives equal output.
// Cost     O(n + m). Thread-safe.
#ifndef ARGMESH_CLIENT_PICTURE_VIEW_H_
#define ARGMESH_CLIENT_PICTURE_VIEW_H_

#include <Eigen/Core>
#include <optional>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct ViewOptions {
  // In the mesh's coordinates, any length > 0.
  std::optional<Eigen::Vector3d> up = std::nullopt;
  // Where the shape looks; used with `up` only. Without it the shape's longer
  // side is shown.
  std::optional<Eigen::Vector3d> front = std::nullopt;
  double yaw_degrees = 33;    // away from straight on
  double pitch_degrees = 22;  // above the horizon
  double margin = 0.05;       // of the picture's smaller side, 0 .. 0.4
};

struct View {
  Eigen::Vector3d right, up, toward;  // orthonormal; toward the eye
  Eigen::Vector3d ground_normal;      // the shape's own up
  Eigen::Vector3d center;             // shown in the middle of the picture
  double pixels_per_unit = 1;
};

// `mesh` has at least one vertex; width and height in pixels.
View FitView(const TriangleMesh& mesh, int width, int height,
             const ViewOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_VIEW_H_
