// Pictures of meshes: ray traced, with smooth shading that keeps creases, key
// and fill light, ambient occlusion, and dark lines where the colour of the
// surface changes.
//
// Input    any triangles, soup too; one colour per face.
// Repeats  equal input and options give bit-equal pixels, whatever the number
//          of threads.
// Fails    kInvalidArgument    colours do not match the faces, an index or a
//                              coordinate is bad, an option outside its range
//          kResourceExhausted  the ray tracer refuses the mesh
// Cost     about 0.2 s for 640 x 480 pixels on two cores. Thread-safe.
#ifndef ARGMESH_CLIENT_PICTURE_RENDER_H_
#define ARGMESH_CLIENT_PICTURE_RENDER_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "client/picture/image.h"
#include "client/picture/view.h"
#include "core/mesh/mesh_write.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// A dot on the surface and the circle of surface points `window` away from it.
struct SurfaceMarker {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double window = 0;  // in the mesh's lengths; 0 draws no circle
  RgbColor dot = {214, 30, 30};
  RgbColor circle = {30, 30, 30};
};

struct RenderOptions {
  int width = 640;   // pixels, 1 .. 4,096
  int height = 480;  // pixels, 1 .. 4,096
  ViewOptions view = {};
  int ambient_rays = 24;       // 0 .. 1,024; 0 for no ambient occlusion
  uint64_t ambient_seed = 1;   // of their directions
  bool ground_shadow = false;  // below the lowest point of the shape
  bool lines = true;           // between colours and at the outline
  double crease_degrees = 38;  // 0 .. 180, sharper bends are creases
  double dot_pixels = 4;       // radius of the markers' dots, >= 0
  std::vector<SurfaceMarker> markers = {};
  RgbColor background = kWhite;
  int threads = 0;  // 0 .. 256; 0 for one per core
};

absl::StatusOr<Image> RenderMesh(const TriangleMesh& mesh,
                                 std::span<const RgbColor> face_colors,
                                 const RenderOptions& options = {});

// In one colour.
absl::StatusOr<Image> RenderMesh(const TriangleMesh& mesh, RgbColor color,
                                 const RenderOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_RENDER_H_
