// Ambient occlusion: for every 2 x 2 pixels the share of the sky that the
// surface point there sees, smoothed where the surface is.
//
// Source   Zhukov, Iones, Kronin, "An Ambient Light Illumination Model",
//          Rendering Techniques 1998.
// Repeats  directions depend on the seed and the pixel alone.
#ifndef ARGMESH_CLIENT_PICTURE_SKY_OPENNESS_H_
#define ARGMESH_CLIENT_PICTURE_SKY_OPENNESS_H_

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "client/picture/ray_scene.h"
#include "client/picture/render.h"
#include "client/picture/surface_shader.h"

namespace argmesh {

// The plane the shape stands on, in the picture's axes.
struct GroundPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitY();
  float offset = 0;  // normal . p = offset
};

class SkyOpenness {
 public:
  // `hits` are those of the pixels' centres, row by row.
  SkyOpenness(const RayScene& scene, const SurfaceShader& shader,
              std::span<const RayHit> hits,
              const std::optional<GroundPlane>& ground,
              const RenderOptions& options);

  // 0 .. 1, of the point seen at (x, y); 1 where nothing is seen.
  float At(int x, int y) const;

 private:
  struct Cell {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // zero: nothing seen
    float z = 0;
    float openness = 1;
  };
  void MeasureRow(int row);
  void SmoothRow(int row);
  const RayHit* HitOfCell(int column, int row, int& x, int& y) const;
  void Measure(int column, int row, Cell& cell) const;

  const RayScene& scene_;
  const SurfaceShader& shader_;
  std::span<const RayHit> hits_;
  std::optional<GroundPlane> ground_;
  const RenderOptions& options_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Cell> cells_;
  std::vector<float> smooth_;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_SKY_OPENNESS_H_
