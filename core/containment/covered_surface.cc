#include "core/containment/covered_surface.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <cstddef>

#include "core/containment/sampled_surface.h"

namespace argmesh {
namespace {

constexpr float kNear = 0.03F;  // of the query's size

// The surface of a query, asked from the target's own units.
class QueryProbe {
 public:
  QueryProbe(const QueryWindows& query, const ContainmentMatch& match)
      : laid_(MakeLaidSurface(query, match.flipped)),
        surface_(laid_.points, laid_.normals,
                 1 / std::sqrt(static_cast<float>(laid_.points.size()))),
        inverse_(match.transform.inverse()),
        frame_(query.frame),
        placed_(match.coarse_cover > 0) {}

  // `direction` of any length.
  bool Covers(const Eigen::Vector3d& point,
              const Eigen::Vector3d& direction) const {
    if (!placed_) return false;
    const Eigen::Vector3d own = inverse_.topLeftCorner<3, 3>() * point +
                                inverse_.topRightCorner<3, 1>();
    const Eigen::Vector3f p =
        (frame_.scale * (own - frame_.origin)).cast<float>();
    const float reach = kNear + surface_.spacing;
    const PointTree::Nearest nearest =
        surface_.tree.FindNearest(p, reach * reach);
    if (nearest.place < 0) return false;
    const Eigen::Vector3f turned =
        (inverse_.topLeftCorner<3, 3>() * direction).cast<float>();
    return turned.dot(surface_.normals[static_cast<size_t>(nearest.place)]) > 0;
  }

 private:
  LaidSurface laid_;
  SampledSurface surface_;
  Eigen::Matrix4d inverse_;
  WindowFrame frame_;
  bool placed_;
};

}  // namespace

std::vector<bool> CoveredFaces(const QueryWindows& query,
                               const ContainmentMatch& match,
                               const TriangleMesh& mesh) {
  const QueryProbe probe(query, match);
  std::vector<bool> covered(static_cast<size_t>(mesh.num_faces()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d a = mesh.vertex(mesh.F(f, 0));
    const Eigen::Vector3d b = mesh.vertex(mesh.F(f, 1));
    const Eigen::Vector3d c = mesh.vertex(mesh.F(f, 2));
    covered[static_cast<size_t>(f)] =
        probe.Covers((a + b + c) / 3, (b - a).cross(c - a));
  }
  return covered;
}

std::vector<bool> CoveredPoints(const QueryWindows& query,
                                const ContainmentMatch& match,
                                const TargetWindows& target) {
  const QueryProbe probe(query, match);
  std::vector<bool> covered;
  covered.reserve(target.points.size());
  for (const PackedPoint& point : target.points) {
    covered.push_back(probe.Covers(
        target.frame.origin +
            UnpackPosition(point).cast<double>() / target.frame.scale,
        UnpackNormal(point).cast<double>()));
  }
  return covered;
}

}  // namespace argmesh
