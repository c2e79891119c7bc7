// A surface seen from all round, as depth images.
#ifndef ARGMESH_CORE_SIGNATURE_DEPTH_VIEWS_H_
#define ARGMESH_CORE_SIGNATURE_DEPTH_VIEWS_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

inline constexpr int kImageSize = 128;

// kImageSize x kImageSize values, row by row: 0 where there is nothing, else
// 0.3 (far end of the bounding ball) .. 1 (near end).
using DepthImage = std::vector<float>;

// 42 directions towards the viewer: the corners of an icosahedron along the
// axes and the middles of its edges, as 21 opposite pairs. Unit.
std::vector<Eigen::Vector3d> ViewDirections();

// Parallel projections of a surface on the origin along one pair of opposite
// directions.
class DepthRenderer {
 public:
  // Scaled so that the ball around the origin that holds the mesh fills 98 %
  // of an image. `mesh` must outlive the renderer.
  explicit DepthRenderer(const TriangleMesh& mesh);

  // The views from `direction` and from its opposite. Faces are seen from both
  // sides. Pixels are seen where their centres are.
  // Cost O(m + pixels), about 0.5 ms for 20,000 faces.
  std::array<DepthImage, 2> Render(const Eigen::Vector3d& direction) const;

 private:
  const TriangleMesh& mesh_;
  double scale_ = 1;
};

// Closes gaps of up to four pixels: maximum, then minimum over 5 x 5 pixels.
void CloseImage(DepthImage& image);

// Every 2 x 2 pixels as their mean; `size` even.
DepthImage HalveImage(const DepthImage& image, int size);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_DEPTH_VIEWS_H_
